// A die: a cube with its corners rounded off by a ball and pips as spherical dents, stretched by
// half upwards, with a polyhedron (a wedge) beside it and things that have no true solid. Millimetres.
scale([1, 1, 1.5]) intersection() {
  difference() {
    cube(20, center = true);
    for (p = [[0, 0, 10], [10, 4, 4], [10, -4, -4]]) translate(p) sphere(2);
  }
  sphere(r = 13.5);
}
translate([30, 0, 0])
  polyhedron(points = [[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0], [0, 0, 10], [0, 10, 10]],
             faces = [[0, 1, 2, 3], [4, 5, 2, 1], [0, 4, 1], [3, 2, 5], [0, 3, 5, 4]]);
translate([0, 40, 0]) hull() { sphere(3); translate([10, 0, 0]) sphere(3); }
translate([0, -40, 0]) minkowski() { cube(5); sphere(1); }
scale([1, 1, 0]) cube(3);
linear_extrude(height = 2) text("six");
%cube(100);
