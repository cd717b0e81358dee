// The kernels of a solve on the paper's room, each beside a rival on the same work, so that ratios
// can be read off one run. Items are rays, or pairs of receiver and emitter.

#include <benchmark/benchmark.h>

#include "isolux/core/random.h"
#include "isolux/discretization/mesh_rays.h"
#include "isolux/radiosity/solve.h"
#include "isolux/radiosity/visibility.h"
#include "isolux/raycast/triangle_tree.h"
#include "isolux/scene/reader.h"

namespace isolux {
namespace {

/// The paper's room, solved for 100 shots, and random work in it.
struct Work {
  Scene scene = load_scene(ISOLUX_SOURCE_DIR "/examples/lalonde1993/room.yaml");
  RayCaster rays{scene};
  Triangulation mesh = [this] {
    Options options;
    options.method = Method::shooting;
    options.iterations = 100;
    return solve(scene, options).mesh;
  }();
  std::vector<Segment> segments;
  std::vector<Receiver> receivers;

  Work() {
    Random random(1);
    for (int i = 0; i < 4096; ++i) {
      const Vertex& from = mesh.vertex(static_cast<VertexId>(random.below(mesh.vertices().size())));
      segments.push_back({from.position + from.normal * rays.epsilon(),
                          {0.45 + 0.1 * random.uniform(), 0.45 + 0.1 * random.uniform(), 0.9999}});
    }
    for (const Vertex& v : mesh.vertices()) receivers.push_back({v.gather_point, v.normal});
  }
};

const Work& work() {
  static const Work instance;
  return instance;
}

void occlusion_in_packets(benchmark::State& state) {
  std::vector<std::uint8_t> blocked(work().segments.size());
  for (auto _ : state) work().rays.occluded(work().segments, blocked);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(blocked.size()));
}
BENCHMARK(occlusion_in_packets);

void occlusion_one_by_one(benchmark::State& state) {
  for (auto _ : state) {
    for (const Segment& s : work().segments) benchmark::DoNotOptimize(work().rays.occluded(s));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(work().segments.size()));
}
BENCHMARK(occlusion_one_by_one);

void mesh_rays_by_tree(benchmark::State& state) {
  const MeshRays mesh_rays(work().mesh);
  std::vector<MeshHit> hits;
  for (auto _ : state) {
    for (const Segment& s : work().segments) mesh_rays.all_hits({s.from, s.to - s.from}, {}, hits);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(work().segments.size()));
}
BENCHMARK(mesh_rays_by_tree);

void mesh_rays_by_brute_force(benchmark::State& state) {
  const Triangulation& mesh = work().mesh;
  const std::size_t n = 64;
  for (auto _ : state) {
    for (std::size_t i = 0; i < n; ++i) {
      const Segment& s = work().segments[i];
      for (const Triangle& t : mesh.triangles()) {
        benchmark::DoNotOptimize(intersect_triangle(
            {mesh.vertex(t.vertices[0]).position, mesh.vertex(t.vertices[1]).position,
             mesh.vertex(t.vertices[2]).position},
            {s.from, s.to - s.from}));
      }
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
}
BENCHMARK(mesh_rays_by_brute_force);

/// One shot of the light to every vertex.
void shot_with_exact_form_factors(benchmark::State& state) {
  const Emitter emitter = emitter_of(work().mesh, 0);
  std::vector<double> factors(work().receivers.size());
  for (auto _ : state) {
    visible_form_factors(work().rays, emitter, work().receivers, 1, factors);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(factors.size()));
}
BENCHMARK(shot_with_exact_form_factors);

/// The same by 64 random points of the light for each vertex: about 1 % off where nothing is
/// hidden.
void shot_by_sampling(benchmark::State& state) {
  constexpr int kSamples = 64;
  const Emitter emitter = emitter_of(work().mesh, 0);
  const double area = work().mesh.triangle(0).area;
  Random random(2);
  std::vector<Segment> segments(kSamples);
  std::vector<std::uint8_t> blocked(kSamples);
  for (auto _ : state) {
    for (const Receiver& receiver : work().receivers) {
      for (Segment& s : segments) {
        const double r = std::sqrt(random.uniform()), q = random.uniform();
        s = {receiver.point + receiver.normal * work().rays.epsilon(),
             emitter.corners[0] * (1 - r) + emitter.corners[1] * (r * (1 - q)) +
                 emitter.corners[2] * (r * q)};
      }
      work().rays.occluded(segments, blocked);
      double factor = 0;
      for (int i = 0; i < kSamples; ++i) {
        const Vec3 d = segments[i].to - segments[i].from;
        const double d2 = length_squared(d);
        const double cosines =
            std::max(0.0, dot(d, receiver.normal)) * std::max(0.0, -dot(d, emitter.normal));
        if (!blocked[i]) factor += cosines / (d2 * d2 * 3.141592653589793) * area / kSamples;
      }
      benchmark::DoNotOptimize(factor);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(work().receivers.size()));
}
BENCHMARK(shot_by_sampling);

}  // namespace
}  // namespace isolux
