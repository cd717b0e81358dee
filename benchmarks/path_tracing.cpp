// The rival of a solve: path tracing of every point of a CSV file, in CPU seconds: to a standard
// error relative to each point's own irradiance, then to one relative to the mean of all, as the
// tolerance of a solve is. Where the file has reference irradiances, says how far off the results
// are.
//
//   path_tracing SCENE.yaml POINTS.csv [RELATIVE_ERROR]
//
// The file has columns x, y, z, nx, ny, nz (m), and perhaps Er after them (in the unit of the
// lights' exitance).

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>

#include "isolux/core/parallel.h"
#include "isolux/scene/reader.h"
#include "path_tracer.h"

namespace isolux {
namespace {

struct Sensor {
  Receiver receiver;
  double reference = 0;
};

std::vector<Sensor> read_sensors(const std::string& path) {
  std::ifstream in(path);
  std::vector<Sensor> sensors;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    Sensor s;
    Vec3 &p = s.receiver.point, &n = s.receiver.normal;
    fields >> p.x >> p.y >> p.z >> n.x >> n.y >> n.z >> s.reference;
    n = normalized(n);
    sensors.push_back(s);
  }
  return sensors;
}

/// Traces all points and prints a line on it, and one on the reference if there is any. Returns the
/// mean irradiance.
double trace(const PathTracer& tracer, std::span<const Sensor> sensors, double relative,
             double absolute, const char* of) {
  constexpr std::uint64_t kMostPaths = 100'000'000;
  std::vector<TracedIrradiance> traced(sensors.size());
  const std::clock_t start = std::clock();
  parallel_for(sensors.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      traced[i] = tracer.irradiance(sensors[i].receiver, relative, absolute, kMostPaths, 1, i);
    }
  });
  const double cpu = double(std::clock() - start) / CLOCKS_PER_SEC;

  double paths = 0, mean = 0, reference = 0, squares = 0, inside = 0, bias = 0;
  const auto n = static_cast<double>(sensors.size());
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double off = traced[i].irradiance - sensors[i].reference;
    paths += static_cast<double>(traced[i].paths) / n;
    mean += traced[i].irradiance / n;
    reference += sensors[i].reference / n;
    squares += off * off / n;
    bias += off / n;
    inside += std::abs(off) <= 2 * traced[i].standard_error;
  }
  fmt::print(
      "standard error of {}: {} points in {:.3f} s of CPU, {:.3f} ms and {:.0f} paths each\n", of,
      sensors.size(), cpu, 1e3 * cpu / n, paths);
  if (reference > 0) {
    fmt::print(
        "  against the reference: relative RMSE {:.3f} %, bias {:+.3f} %, within 2 standard "
        "errors {:.1f} %\n",
        100 * std::sqrt(squares) / reference, 100 * bias / reference, 100 * inside / n);
  }
  return mean;
}

void run(const std::string& scene_path, const std::string& points_path, double error) {
  const Scene scene = load_scene(scene_path);
  const std::vector<Sensor> sensors = read_sensors(points_path);
  const RayCaster rays(scene);
  const PathTracer tracer(rays);
  fmt::print("relative error {}\n", error);
  const double mean = trace(tracer, sensors, error, 0, "each point's own");
  trace(tracer, sensors, 0, error * mean, "the mean");
}

}  // namespace
}  // namespace isolux

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: path_tracing SCENE.yaml POINTS.csv [RELATIVE_ERROR]\n");
    return 2;
  }
  isolux::run(argv[1], argv[2], argc > 3 ? std::stod(argv[3]) : 0.01);
}
