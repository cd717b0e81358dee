// A whole solve to a tolerance beside its rival on the same work, in CPU seconds of one thread:
// path tracing of the solution's vertices, each to a standard error of the same size relative to
// the mean of all, as the tolerance of a solve is. With POINTS.csv also: solving and measuring
// there, beside path tracing those points; where the file has reference irradiances, how far off
// both are.
//
//   path_tracing SCENE.yaml [POINTS.csv] [TOLERANCE]
//
// The file has columns x, y, z, nx, ny, nz (m), and perhaps Er after them (in the unit of the
// lights' exitance). Of very many vertices a thousand are traced, and their time is scaled up.

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>

#include "isolux/core/parallel.h"
#include "isolux/measure/measure.h"
#include "isolux/radiosity/solve.h"
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

double cpu_since(std::clock_t start) { return double(std::clock() - start) / CLOCKS_PER_SEC; }

/// Where there are reference values: how far off `values` are.
void print_deviation(std::span<const Sensor> sensors, std::span<const double> values) {
  double reference = 0, squares = 0, bias = 0;
  const auto n = static_cast<double>(sensors.size());
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double off = values[i] - sensors[i].reference;
    reference += sensors[i].reference / n;
    squares += off * off / n;
    bias += off / n;
  }
  if (!(reference > 0)) return;
  fmt::print("    off the reference: relative RMSE {:.3f} %, bias {:+.3f} %\n",
             100 * std::sqrt(squares) / reference, 100 * bias / reference);
}

/// Path traces the points to a standard error (lx), prints a line on it and returns the CPU s.
double trace(const PathTracer& tracer, std::span<const Sensor> sensors, double error) {
  constexpr std::uint64_t kMostPaths = 100'000'000;
  std::vector<double> traced(sensors.size());
  double paths = 0;
  const std::clock_t start = std::clock();
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const TracedIrradiance found =
        tracer.irradiance(sensors[i].receiver, 0, error, kMostPaths, 1, i);
    traced[i] = found.irradiance;
    paths += static_cast<double>(found.paths) / static_cast<double>(sensors.size());
  }
  const double cpu = cpu_since(start);
  fmt::print("  path tracing {} points: {:.3f} s, {:.3f} ms and {:.0f} paths each\n",
             sensors.size(), cpu, 1e3 * cpu / static_cast<double>(sensors.size()), paths);
  print_deviation(sensors, traced);
  return cpu;
}

void run(const std::string& scene_path, const std::string& points_path, double tolerance) {
  constexpr std::size_t kMostTraced = 1000;
  const ThreadLimit one_thread(1);
  Options options;
  options.tolerance = tolerance;

  std::clock_t start = std::clock();
  Scene scene = load_scene(scene_path);
  Solved solved = solve(scene, options);
  const double solving = cpu_since(start);
  const Solution solution{std::move(scene), std::move(solved.mesh), options, solved.statistics, ""};
  const std::size_t n = solution.mesh.vertices().size();
  fmt::print(
      "{}, tolerance {} %, one thread, s of CPU\n  solve: {:.3f} s, {} vertices, {:.3f} ms "
      "each, estimated error {:.2f} %\n",
      scene_path, 100 * tolerance, solving, n, 1e3 * solving / static_cast<double>(n),
      100 * solution.statistics.error);

  const RayCaster rays(solution.scene);
  const PathTracer tracer(rays);
  const double error = tolerance * solution.statistics.mean_irradiance;
  std::vector<Sensor> vertices;
  const std::size_t step = (n + kMostTraced - 1) / kMostTraced;
  for (std::size_t v = 0; v < n; v += step) {
    const Vertex& vertex = solution.mesh.vertex(static_cast<VertexId>(v));
    vertices.push_back({{vertex.gather_point, vertex.normal}, 0});
  }
  const double tracing = trace(tracer, vertices, error) * static_cast<double>(n) /
                         static_cast<double>(vertices.size());
  fmt::print("  all vertices by path tracing: {:.2f} s, {:.1f} x the solve\n", tracing,
             tracing / solving);
  if (points_path.empty()) return;

  const std::vector<Sensor> sensors = read_sensors(points_path);
  std::vector<MeasurePoint> points;
  for (const Sensor& s : sensors) points.push_back({s.receiver.point, s.receiver.normal});
  start = std::clock();
  std::vector<double> measured;
  for (const Measurement& m : measure(solution, points)) measured.push_back(m.illuminance());
  const double measuring = cpu_since(start);
  fmt::print("{}\n  solve and measure {} points: {:.3f} + {:.3f} s\n", points_path, points.size(),
             solving, measuring);
  print_deviation(sensors, measured);
  const double rival = trace(tracer, sensors, error);
  fmt::print("  path tracing takes {:.1f} x as long\n", rival / (solving + measuring));
}

}  // namespace
}  // namespace isolux

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: path_tracing SCENE.yaml [POINTS.csv] [TOLERANCE]\n");
    return 2;
  }
  const std::string second = argc > 2 ? argv[2] : "";
  const bool points = second.ends_with(".csv");
  const int at = points ? 3 : 2;
  isolux::run(argv[1], points ? second : "", argc > at ? std::stod(argv[at]) : 0.01);
}
