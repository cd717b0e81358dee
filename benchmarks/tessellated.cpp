// What true surfaces save: one scene solved as drawn, and with its spheres and cylinders cut into
// more and more flat triangles; CPU seconds of one thread, and their ratio to the scene as drawn.
//
//   tessellated SCENE.yaml [TOLERANCE]

#include "support/tessellated.h"

#include <fmt/format.h>

#include <cstdlib>

#include "isolux/core/parallel.h"
#include "isolux/radiosity/solve.h"
#include "isolux/scene/reader.h"

namespace isolux {
namespace {

void compare(const Scene& drawn, double tolerance) {
  Options options;
  options.tolerance = tolerance;
  const auto report = [&](const std::string& name, const Scene& scene, double rival) {
    std::size_t flat = 0;
    for (const Object& object : scene.objects) {
      if (object.shape->part_count() > 1) flat += object.shape->part_count();
    }
    const Statistics s = solve(scene, options).statistics;
    fmt::print("{:12} {:7} flat pieces, {:7} triangles of the mesh, {:.5g} lx, {:6.2f} s{}\n", name,
               flat, s.triangles, s.mean_irradiance, s.cpu_seconds,
               rival > 0 ? fmt::format(", ratio {:.2f}", s.cpu_seconds / rival) : "");
    return s.cpu_seconds;
  };
  const double seconds = report("as drawn", drawn, 0);
  for (const std::uint32_t segments : {16, 32, 64, 128, 256}) {
    report(fmt::format("{} segments", segments), tessellated(drawn, segments), seconds);
  }
}

}  // namespace
}  // namespace isolux

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: tessellated SCENE.yaml [TOLERANCE]\n");
    return 1;
  }
  const isolux::ThreadLimit limit(1);
  isolux::compare(isolux::load_scene(argv[1]), argc > 2 ? std::atof(argv[2]) : 0.01);
}
