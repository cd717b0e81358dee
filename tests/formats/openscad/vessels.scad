// Extrusions of flat things, each alone and of one color. Millimetres.
color("red") linear_extrude(height = 20, scale = 0.5)
  difference() { square([20, 10], center = true); circle(r = 3); }
color("lime") translate([50, 0, 0]) linear_extrude(height = 30, twist = 90)
  square([10, 10], center = true);
color("blue") translate([0, 50, 0]) rotate_extrude(angle = 90)
  translate([20, 0]) circle(r = 5);
color("white") translate([50, 50, 0]) rotate_extrude()
  difference() { circle(r = 10); translate([-20, -10]) square(20); circle(r = 8); }
color("#808080") translate([0, -50, 0]) linear_extrude(height = 5)
  polygon([[0, 0], [30, 0], [30, 30], [0, 30], [5, 5], [25, 5], [25, 25], [5, 25],
           [10, 10], [20, 10], [20, 20], [10, 20]],
          paths = [[0, 1, 2, 3], [4, 5, 6, 7], [8, 9, 10, 11]]);
