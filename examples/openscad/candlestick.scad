// A candlestick on a table in a niche, for isolux: its lights stand in candlestick.lights.yaml.
// Millimetres, z up. Made with: openscad -o candlestick.csg candlestick.scad

// The niche: a room with an open front.
color("#f0e8d8") difference() {
  translate([-620, -420, -20]) cube([1240, 1020, 920]);
  translate([-600, -1000, 0]) cube([1200, 1580, 880]);
}

// The table top, its edge turned off by a cone.
color("#8a5a32") difference() {
  translate([0, 150, 0]) cylinder(h = 40, r = 340);
  translate([0, 150, -1]) difference() {
    cylinder(h = 30, r = 400);
    cylinder(h = 30, r1 = 300, r2 = 345);
  }
}

translate([0, 120, 40]) {
  // Foot, stem and bowl in one turn, bored out for the candle.
  color("#c8a040") difference() {
    rotate_extrude()
      polygon([[0, 0], [70, 0], [72, 8], [40, 18], [14, 40], [11, 90], [18, 104], [11, 118],
               [13, 150], [44, 178], [46, 186], [0, 186]]);
    translate([0, 0, 166]) cylinder(h = 40, r = 14);
    // Flutes in the foot.
    for (i = [0 : 11]) rotate(30 * i) translate([62, 0, 21]) sphere(11);
  }
  // A twisted candle and its flame.
  color("#f4f0e4") translate([0, 0, 166])
    linear_extrude(height = 150, twist = 240) circle(r = 16, $fn = 6);
  color([1, 0.8, 0.3]) translate([0, 0, 330]) scale([1, 1, 2.4]) sphere(6);
}

// A ring, a hexagonal nut and a die beside it.
color("#b04030") translate([-170, 60, 52]) rotate_extrude() translate([40, 0]) circle(r = 12);
color("#607080") translate([150, 10, 40]) rotate(20) difference() {
  cylinder(h = 30, r = 40, $fn = 6);
  translate([0, 0, -1]) cylinder(h = 40, r = 20);
  translate([0, 0, 22]) cylinder(h = 9, r1 = 20, r2 = 29);
}
color("#4a7a50") translate([140, 210, 75]) rotate(30) intersection() {
  cube(70, center = true);
  sphere(r = 47);
}
