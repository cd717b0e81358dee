#include "isolux/radiosity/refine.h"

#include <algorithm>
#include <array>

#include "isolux/core/parallel.h"
#include "isolux/discretization/interpolation.h"
#include "isolux/sampling/hemisphere.h"

namespace isolux {
namespace {

// Rays traced together; more would meet too many triangles that are not yet in the tree.
constexpr std::size_t kBatch = 256;
constexpr std::size_t kGrain = 32;

// Stream of the random numbers that refinement draws.
constexpr std::uint64_t kStream = 1;

// Two triangles met this close together (in t) were met on their common side.
constexpr double kSameSide = 1e-7;

}  // namespace

Refinement::Refinement(Triangulation& mesh, const RayCaster& rays, const Options& options,
                       Statistics& statistics)
    : mesh_(mesh),
      rays_(rays),
      options_(options),
      statistics_(statistics),
      mesh_rays_(mesh),
      random_(options.seed, kStream),
      cos_normal_tolerance_(std::cos(mesh.rules().normal_tolerance)),
      scene_hits_(kBatch),
      mesh_hits_(kBatch) {}

void Refinement::refine(const Shot& shot) {
  const auto corners = mesh_.triangle(shot.triangle).vertices;
  for (VertexId corner : corners) {
    const Vec3 origin = mesh_.vertex(corner).gather_point;
    const Frame frame(mesh_.vertex(corner).normal);
    std::vector<Vec3> directions = options_.distribution == Distribution::malley
                                       ? malley_hemisphere(frame, options_.grid, random_)
                                       : uniform_hemisphere(frame, options_.grid, random_);
    if (options_.least_rays > 0) {
      const int grid = static_cast<int>(std::ceil(std::sqrt(options_.least_rays)));
      const std::vector<Vec3> more = uniform_hemisphere(frame, grid, random_);
      directions.insert(directions.end(), more.begin(), more.end());
    }
    refine_along(origin + frame.n * rays_.epsilon(), directions, &shot);
  }
}

void Refinement::refine_from_eye(const Camera& camera) {
  const int grid = options_.eye_grid;
  std::vector<Vec3> directions;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      const double x = (i + random_.uniform()) / grid, y = (j + random_.uniform()) / grid;
      directions.push_back(camera.ray(x, y).direction);
    }
  }
  for (std::size_t i = directions.size(); i > 1; --i) {
    std::swap(directions[i - 1], directions[random_.below(i)]);
  }
  refine_along(camera.eye, directions, nullptr);
}

void Refinement::refine_along(const Vec3& origin, std::span<const Vec3> directions,
                              const Shot* shot) {
  for (std::size_t first = 0; first < directions.size(); first += kBatch) {
    const auto batch = directions.subspan(first, std::min(kBatch, directions.size() - first));
    mesh_rays_.update();
    const auto born = static_cast<TriangleId>(mesh_.triangles().size());
    parallel_for(batch.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      std::array<Ray, kGrain> rays;
      for (std::size_t i = begin; i < end; ++i) {
        rays[i - begin] = {origin, batch[i]};
        rays_.all_hits(rays[i - begin], {}, scene_hits_[i]);
      }
      const std::size_t n = end - begin;
      mesh_rays_.all_hits(std::span(rays).first(n), {}, std::span(mesh_hits_).subspan(begin, n));
    });
    // What earlier rays of the batch have built or removed counts for the later ones.
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Ray ray{origin, batch[i]};
      merged_.clear();
      for (const MeshHit& hit : mesh_hits_[i]) {
        if (mesh_.triangle(hit.triangle).alive) merged_.push_back(hit);
      }
      const std::size_t old = merged_.size();
      mesh_rays_.hits_since(born, ray, {}, merged_);
      if (merged_.size() > old) {
        std::sort(merged_.begin(), merged_.end(), [](const MeshHit& a, const MeshHit& b) {
          return std::pair(a.t, a.triangle) < std::pair(b.t, b.triangle);
        });
      }
      // Light never gets to a surface inside another solid: there is nothing to discretize.
      std::erase_if(scene_hits_[i],
                    [&](const SurfaceHit& hit) { return rays_.buried(hit.point, hit.normal); });
      compare(scene_hits_[i], merged_, shot);
    }
    statistics_.refinement_rays += batch.size();
  }
}

/// The three cases of §3.2.3.
void Refinement::compare(std::span<const SurfaceHit> scene_hits, std::span<const MeshHit> mesh_hits,
                         const Shot* shot) {
  pair_by_distance(mesh_, scene_hits, mesh_hits, options_.pairing_tolerance, pairs_);
  for (const HitPair& pair : pairs_) {
    if (pair.scene < 0) remove_from_triangulation(mesh_hits[pair.mesh], mesh_hits, pairs_);
  }
  for (const HitPair& pair : pairs_) {
    if (pair.scene < 0) continue;
    const SurfaceHit& hit = scene_hits[pair.scene];
    // Lights are discretized beforehand.
    if (!hit.back && rays_.scene().objects[hit.surface.object].emits()) continue;
    if (pair.mesh < 0) {
      extend_triangulation(hit, shot);
    } else {
      refine_triangulation(mesh_hits[pair.mesh], hit, shot);
    }
  }
}

void Refinement::remove_from_triangulation(const MeshHit& hit, std::span<const MeshHit> mesh_hits,
                                           std::span<const HitPair> pairs) {
  const bool on_side = std::any_of(pairs.begin(), pairs.end(), [&](const HitPair& pair) {
    return pair.scene >= 0 && pair.mesh >= 0 &&
           std::abs(mesh_hits[pair.mesh].t - hit.t) < kSameSide * hit.t;
  });
  const Triangle& triangle = mesh_.triangle(hit.triangle);
  if (on_side || !triangle.alive || triangle.on_light) return;
  mesh_.remove(hit.triangle);
  ++statistics_.removed;
}

void Refinement::extend_triangulation(const SurfaceHit& hit, const Shot* shot) {
  const SurfacePoint point = surface_point(hit);
  const std::optional<VertexId> v = mesh_.extend(point);
  if (!v) return;
  ++statistics_.extended;
  Vertex& vertex = mesh_.vertex(*v);
  light_newborn(vertex, extrapolate_irradiance(mesh_, point, vertex.neighbours, true), shot);
}

void Refinement::refine_triangulation(const MeshHit& mesh_hit, const SurfaceHit& hit,
                                      const Shot* shot) {
  const Triangle& triangle = mesh_.triangle(mesh_hit.triangle);
  if (!triangle.alive || triangle.on_light || triangle.area <= mesh_.rules().min_area) return;
  // Most triangles are flat: this spares looking at their corners.
  constexpr double kRounding = 1e-6;
  if (triangle.flat && dot(triangle.normal, hit.normal) > cos_normal_tolerance_ + kRounding) return;
  const bool bent = std::any_of(
      triangle.vertices.begin(), triangle.vertices.end(),
      [&](VertexId v) { return dot(mesh_.vertex(v).normal, hit.normal) < cos_normal_tolerance_; });
  if (!bent) return;
  mesh_.remove(mesh_hit.triangle);
  ++statistics_.removed;
  extend_triangulation(hit, shot);
}

void Refinement::split_triangles(const Shot& shot, std::span<const double> delta) {
  const auto too_different = [&](const Triangle& triangle) {
    const auto& [v, w, x] = triangle.vertices;
    const auto [least, most] = std::minmax({delta[v], delta[w], delta[x]});
    return most - least > options_.contrast * (delta[v] + delta[w] + delta[x]) / 3;
  };
  const std::size_t n = mesh_.triangles().size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto id = static_cast<TriangleId>(i);
    const Triangle& triangle = mesh_.triangle(id);
    if (!triangle.alive || triangle.on_light) continue;
    if (triangle.area / 3 < mesh_.rules().min_area || !too_different(triangle)) continue;
    const std::optional<SurfaceHit> hit = scene_point_over_center(triangle);
    if (!hit) continue;
    Rgb earlier;
    for (VertexId corner : triangle.vertices) {
      const Vertex& vertex = mesh_.vertex(corner);
      earlier += (vertex.irradiance - vertex.delta_irradiance) / 3;
    }
    const std::optional<VertexId> v = mesh_.split(id, surface_point(*hit));
    if (!v) continue;
    ++statistics_.split;
    light_newborn(mesh_.vertex(*v), earlier, &shot);
  }
}

std::optional<SurfaceHit> Refinement::scene_point_over_center(const Triangle& triangle) const {
  Vec3 center;
  for (VertexId v : triangle.vertices) center += mesh_.vertex(v).position / 3;
  const double reach = 0.25 * std::sqrt(triangle.area);
  const Ray ray{center + triangle.normal * reach, -triangle.normal};
  thread_local std::vector<SurfaceHit> hits;
  rays_.all_hits(ray, {0, 2 * reach}, hits);
  std::optional<SurfaceHit> closest;
  for (const SurfaceHit& hit : hits) {
    if (dot(hit.normal, triangle.normal) < 0.3 || rays_.buried(hit.point, hit.normal)) continue;
    if (!closest || std::abs(hit.t - reach) < std::abs(closest->t - reach)) closest = hit;
  }
  return closest;
}

void Refinement::light_newborn(Vertex& vertex, const Rgb& earlier, const Shot* shot) {
  if (shot) {
    const Receiver receiver{vertex.gather_point, vertex.normal};
    double factor = 0;
    statistics_.shadow_rays += visible_form_factors(rays_, shot->emitter, {&receiver, 1},
                                                    options_.subdivisions, {&factor, 1});
    vertex.delta_irradiance = shot->radiosity * factor;
  }
  vertex.irradiance = earlier + vertex.delta_irradiance;
}

SurfacePoint Refinement::surface_point(const SurfaceHit& hit) const {
  return {hit.point, hit.normal, hit.surface,
          rays_.scene().material_of(hit.surface.object).reflectance};
}

}  // namespace isolux
