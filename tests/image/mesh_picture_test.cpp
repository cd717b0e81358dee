#include "isolux/image/mesh_picture.h"

#include <gtest/gtest.h>

#include "solution/small_solution.h"

namespace isolux {
namespace {

// Seen from above, the floor is two triangles: dark along the diagonal from (0, 0) to (1, 1) and
// along the walls, bright elsewhere, with the ball, which has no mesh, in the middle. The floor
// fills the picture.
TEST(MeshPicture, LinesRunAlongTheSidesOfTriangles) {
  const Solution solution = small_solution();
  Camera camera;
  camera.eye = {0.5, 0.5, 0.999}, camera.look_at = {0.5, 0.5, 0}, camera.up = {0, 1, 0};
  camera.fov = 53.17, camera.width = camera.height = 100;
  const Picture picture = mesh_picture(solution, camera);
  const auto darkest_near = [&](int x, int y) {
    double least = 1;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        least = std::min(least, luminance(picture.at(x + dx, y + dy)));
      }
    }
    return least;
  };
  for (int i = 5; i < 15; ++i) {
    EXPECT_LT(darkest_near(i, 99 - i), 0.5) << "on the diagonal";
    EXPECT_GT(darkest_near(i + 20, 99 - i), 0.6) << "off the diagonal";
  }
  EXPECT_GT(darkest_near(50, 50), 0.6) << "on the ball";
  for (const Rgb& c : picture.pixels) {
    EXPECT_GE(min_channel(c), 0);
    EXPECT_LE(max_channel(c), 1);
  }
}

}  // namespace
}  // namespace isolux
