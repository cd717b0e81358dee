// Two roads to reflected light over the same mesh, in CPU seconds of one thread: stratified rays
// over the hemisphere, which look the radiosity up where they land, and links to a tree of emitters
// with visibility rays. Both are held against very many rays over the hemisphere.
//
//   two_roads SCENE.yaml [TOLERANCE] [RECEIVERS]
//
// In the hair's breadth along creases that the mesh leaves bare the tree has no emitters; so that
// this does not hide all else, errors are of the four in five receivers that are least off.

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <tuple>

#include "emitter_tree.h"
#include "isolux/core/parallel.h"
#include "isolux/radiosity/direct_light.h"
#include "isolux/radiosity/hemisphere_gather.h"
#include "isolux/radiosity/solve.h"
#include "isolux/radiosity/spatial_order.h"
#include "isolux/scene/reader.h"

namespace isolux {
namespace {

constexpr std::size_t kGroup = 16;
constexpr int kReferenceGrid = 128;

double cpu_since(std::clock_t start) { return double(std::clock() - start) / CLOCKS_PER_SEC; }

/// Groups of neighbours on one surface, strewn over all of them.
std::vector<Receiver> receivers_of(const Triangulation& mesh, std::size_t most) {
  std::vector<Vec3> places;
  for (const Vertex& v : mesh.vertices()) places.push_back(v.position);
  std::vector<std::uint32_t> order = z_order(places);
  const auto surface = [&](std::uint32_t v) {
    const Vertex& x = mesh.vertex(v);
    const auto side = [](double c) { return std::lround(c); };
    return std::tuple(x.surface.object, x.surface.face, side(x.normal.x), side(x.normal.y),
                      side(x.normal.z));
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return surface(a) < surface(b); });
  std::vector<Receiver> receivers;
  const std::size_t step = kGroup * std::max<std::size_t>(1, order.size() / most);
  for (std::size_t first = 0; first + kGroup <= order.size(); first += step) {
    for (std::size_t i = first; i < first + kGroup; ++i) {
      const Vertex& v = mesh.vertex(order[i]);
      receivers.push_back({v.gather_point, v.normal});
    }
  }
  return receivers;
}

class TwoRoads {
 public:
  TwoRoads(const Scene& scene, const Triangulation& mesh, std::size_t most)
      : rays_(scene),
        mesh_(mesh),
        lights_(rays_),
        hemisphere_(rays_, mesh, lights_.separate()),
        receivers_(receivers_of(mesh, most)) {
    for (const Vertex& v : mesh.vertices()) irradiance_.push_back(v.mean_irradiance);
    reference_ = by_rays(kReferenceGrid, 2);
    for (const double e : reference_) mean_ += e / double(receivers_.size());
  }

  void compare_rays(int grid) const {
    const std::clock_t start = std::clock();
    const std::vector<double> found = by_rays(grid, 1);
    fmt::print("  rays {:5}: {:6.1f} us a receiver, {:.3f} % off\n", grid * grid,
               micros_since(start), off(found));
  }

  void compare_tree(double epsilon) const {
    std::clock_t start = std::clock();
    const EmitterTree tree(rays_, mesh_, lights_.separate());
    const std::vector<double> radiosity = tree.radiosities(irradiance_);
    const double building = cpu_since(start);
    start = std::clock();
    std::vector<std::vector<EmitterTree::Link>> rows(receivers_.size());
    std::uint64_t ray_count = 0, links = 0;
    for (std::size_t i = 0; i < receivers_.size(); i += kGroup) {
      ray_count += tree.link(std::span(receivers_).subspan(i, kGroup), radiosity, epsilon * mean_,
                             i, std::span(rows).subspan(i, kGroup));
    }
    std::vector<double> found;
    for (const auto& row : rows) {
      double sum = 0, all = 0;
      for (const auto& [node, factor] : row) sum += factor * radiosity[node], all += factor;
      found.push_back(all > 0 ? sum / all : 0);  // closed scenes: form factors add up to 1
      links += row.size();
    }
    const auto n = double(receivers_.size());
    fmt::print(
        "  tree {:.0e}: {:6.1f} us a receiver, {:.3f} % off; {:.0f} links, {:.0f} rays, "
        "built in {:.1f} ms\n",
        epsilon, micros_since(start), off(found), double(links) / n, double(ray_count) / n,
        1e3 * building);
  }

 private:
  std::vector<double> by_rays(int grid, std::uint64_t seed) const {
    std::vector<double> found;
    Row<Landing> row;
    for (std::size_t i = 0; i < receivers_.size(); ++i) {
      hemisphere_.trace(receivers_[i], grid, seed, i, row);
      found.push_back(luminance(hemisphere_.gather(row, irradiance_)));
    }
    return found;
  }

  double micros_since(std::clock_t start) const {
    return 1e6 * cpu_since(start) / double(receivers_.size());
  }

  /// Root mean square of the differences to the reference, per cent of its mean.
  double off(std::span<const double> found) const {
    std::vector<double> squares;
    for (std::size_t i = 0; i < found.size(); ++i) {
      squares.push_back((found[i] - reference_[i]) * (found[i] - reference_[i]));
    }
    std::sort(squares.begin(), squares.end());
    squares.resize(squares.size() * 4 / 5);
    double sum = 0;
    for (const double s : squares) sum += s / double(squares.size());
    return 100 * std::sqrt(sum) / mean_;
  }

  const RayCaster rays_;
  const Triangulation& mesh_;
  const DirectLight lights_;
  const HemisphereGather hemisphere_;
  const std::vector<Receiver> receivers_;
  std::vector<Rgb> irradiance_;
  std::vector<double> reference_;
  double mean_ = 0;
};

void run(const std::string& path, double tolerance, std::size_t most) {
  const ThreadLimit one_thread(1);
  Options options;
  options.tolerance = tolerance;
  const Scene scene = load_scene(path);
  const Solved solved = solve(scene, options);
  fmt::print("{}, tolerance {} %, {} vertices\n", path, 100 * tolerance,
             solved.mesh.vertices().size());
  const TwoRoads roads(scene, solved.mesh, most);
  for (const int grid : {8, 14, 20, 28, 40}) roads.compare_rays(grid);
  for (const double epsilon : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4}) roads.compare_tree(epsilon);
}

}  // namespace
}  // namespace isolux

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: two_roads SCENE.yaml [TOLERANCE] [RECEIVERS]\n");
    return 2;
  }
  isolux::run(argv[1], argc > 2 ? std::stod(argv[2]) : 0.01, argc > 3 ? std::stoul(argv[3]) : 2000);
}
