// A flange: a turned body with a bore, six bolt holes on a circle and a hexagonal boss. Millimetres.
difference() {
  union() {
    rotate_extrude()
      polygon([[0, 0], [50, 0], [50, 10], [25, 10], [15, 40], [0, 40]]);
    translate([0, 0, 40]) cylinder(h = 10, r = 15, $fn = 6);
  }
  translate([0, 0, -1]) cylinder(h = 60, r = 8);
  for (i = [0 : 5])
    rotate(60 * i) translate([38, 0, -1]) cylinder(h = 12, r = 4);
}
