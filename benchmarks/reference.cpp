// Illuminance at points by path tracing alone, for tests to hold solves against.
//
//   reference SCENE.yaml POINTS.csv [STANDARD_ERROR]
//
// The file has a header and a row for each point, x,y,z,nx,ny,nz (m); what comes after is not read.
// Paths are traced until the standard error is that part of the illuminance (default 0.003). To
// standard output: the same columns, the illuminance E and its standard error in lx. Colours must
// be grey.

#include <fmt/format.h>

#include <fstream>

#include "isolux/core/parallel.h"
#include "isolux/measure/csv.h"
#include "isolux/scene/reader.h"
#include "path_tracer.h"

namespace isolux {
namespace {

void run(const std::string& scene_path, const std::string& points_path, double error) {
  constexpr std::uint64_t kMostPaths = 100'000'000;
  const Scene scene = load_scene(scene_path);
  const RayCaster rays(scene);
  const PathTracer tracer(rays);
  const std::vector<MeasurePoint> points = load_points(points_path);
  std::vector<TracedIrradiance> traced(points.size());
  parallel_for(points.size(), 1, [&](std::size_t i, std::size_t) {
    const Receiver receiver{points[i].position, points[i].normal};
    traced[i] = tracer.irradiance(receiver, error, 0, kMostPaths, 1, i);
  });
  fmt::print("x,y,z,nx,ny,nz,E,standard_error\n");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [p, n] = points[i];
    fmt::print("{:g},{:g},{:g},{:g},{:g},{:g},{:.6g},{:.3g}\n", p.x, p.y, p.z, n.x, n.y, n.z,
               traced[i].irradiance, traced[i].standard_error);
  }
}

}  // namespace
}  // namespace isolux

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: reference SCENE.yaml POINTS.csv [STANDARD_ERROR]\n");
    return 2;
  }
  isolux::run(argv[1], argv[2], argc > 3 ? std::stod(argv[3]) : 0.003);
}
