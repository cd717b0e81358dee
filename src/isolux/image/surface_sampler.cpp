#include "isolux/image/surface_sampler.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "isolux/discretization/interpolation.h"

namespace isolux {
namespace {

// Where a point can't be connected to any vertex, these many of the nearest within this many δ
// stand in, each weighing the cosine between the normals over the square of the distance.
constexpr std::size_t kStandIns = 6;
constexpr double kStandInReach = 3;

}  // namespace

SurfaceSampler::SurfaceSampler(const Solution& solution)
    : solution_(solution),
      rays_(solution.scene),
      mesh_rays_(solution.mesh),
      vertices_(solution.scene.bounds().lower, solution.mesh.rules().max_edge) {
  const auto vertices = solution.mesh.vertices();
  if (solution.options.method == Method::gathering) {
    lookup_.emplace(solution.mesh, &rays_);
    return;
  }
  for (VertexId v = 0; v < vertices.size(); ++v) {
    if (!vertices[v].on_light) vertices_.insert(v, vertices[v].position);
  }
}

SurfaceSample SurfaceSampler::sample(const Ray& ray, Scratch& scratch) const {
  const std::optional<SurfaceHit> hit = rays_.nearest(ray);
  const Scene& scene = solution_.scene;
  if (!hit) {
    return {SampleKind::background,
            scene.sky ? scene.sky->luminance(ray.direction) * std::numbers::pi : Rgb{}};
  }
  if (dot(hit->normal, ray.direction) >= 0) return {SampleKind::dark, {}};

  const Object& object = scene.objects[hit->surface.object];
  const Rgb reflectance = scene.material_of(hit->surface.object).reflectance;
  const Rgb emission = hit->back ? Rgb{} : object.exitance;
  if (lookup_) {
    SurfaceSample sample = looked_up(*hit);
    sample.exitance = emission + reflectance * sample.exitance;
    sample.reflectance = reflectance;
    return sample;
  }
  if (const std::optional<MeshHit> mesh = paired(ray, *hit, scratch)) {
    const Rgb irradiance = interpolate_irradiance(
        solution_.mesh, place_in(solution_.mesh, mesh->triangle, ray.at(mesh->t)));
    return {SampleKind::interpolated, emission + reflectance * irradiance};
  }
  const SurfacePoint point{hit->point, hit->normal, hit->surface, reflectance};
  const std::optional<Rgb> irradiance = extrapolated(point, scratch);
  if (!irradiance) return {SampleKind::dark, emission};
  return {SampleKind::extrapolated, emission + reflectance * *irradiance};
}

/// The irradiance, in place of the exitance, at a point of a mesh by gathering.
SurfaceSample SurfaceSampler::looked_up(const SurfaceHit& hit) const {
  SurfaceSample sample{SampleKind::interpolated, {}, {hit.point, hit.normal}};
  const std::optional<SurfaceHit> met = hit;
  lookup_->covering({&met, 1}, {&sample.place, 1});
  if (!sample.place) {
    sample.kind = SampleKind::extrapolated;
    sample.place = lookup_->nearest(hit.point, hit.normal);
  }
  if (!sample.place) {
    sample.kind = SampleKind::dark;
    return sample;
  }
  sample.exitance = interpolate_irradiance(solution_.mesh, *sample.place);
  return sample;
}

std::optional<MeshHit> SurfaceSampler::triangle(const Ray& ray, Scratch& scratch) const {
  const std::optional<SurfaceHit> hit = rays_.nearest(ray);
  if (!hit || dot(hit->normal, ray.direction) >= 0) return std::nullopt;
  return paired(ray, *hit, scratch);
}

std::optional<MeshHit> SurfaceSampler::paired(const Ray& ray, const SurfaceHit& hit,
                                              Scratch& scratch) const {
  const double tolerance = solution_.options.pairing_tolerance;
  // A hair more than the tolerance: the ends of an interval do not belong to it.
  const double reach = 1.001 * tolerance * hit.t + rays_.epsilon();
  mesh_rays_.all_hits(ray, {hit.t - reach, hit.t + reach}, scratch.hits);
  pair_by_distance(solution_.mesh, {&hit, 1}, scratch.hits, tolerance, scratch.pairs);
  const int found = scratch.pairs.front().mesh;
  if (found < 0) return std::nullopt;
  return scratch.hits[static_cast<std::size_t>(found)];
}

std::optional<Rgb> SurfaceSampler::extrapolated(const SurfacePoint& point, Scratch& scratch) const {
  const Triangulation& mesh = solution_.mesh;
  const std::vector<VertexId> connected = mesh.connectable(point);
  if (!connected.empty()) return extrapolate_irradiance(mesh, point, connected);

  return stand_ins(point, scratch.near);
}

std::optional<Rgb> SurfaceSampler::stand_ins(const SurfacePoint& point,
                                             std::vector<VertexId>& near) const {
  const Triangulation& mesh = solution_.mesh;
  const double reach = kStandInReach * mesh.rules().max_edge;
  const auto away = [&](VertexId v) { return distance(mesh.vertex(v).position, point.position); };
  const auto cosine = [&](VertexId v) { return dot(mesh.vertex(v).normal, point.normal); };
  vertices_.query(point.position, reach, near);
  std::erase_if(near, [&](VertexId v) { return !(cosine(v) > 1e-6 && away(v) <= reach); });
  // Those that face alike come first, where there are any.
  const double least = std::cos(mesh.rules().normal_tolerance);
  const auto alike = [&](VertexId v) { return cosine(v) >= least; };
  if (std::any_of(near.begin(), near.end(), alike)) std::erase_if(near, std::not_fn(alike));
  std::sort(near.begin(), near.end(),
            [&](VertexId a, VertexId b) { return std::pair(away(a), a) < std::pair(away(b), b); });
  if (near.size() > kStandIns) near.resize(kStandIns);
  if (near.empty()) return std::nullopt;

  Rgb sum;
  double weights = 0;
  for (VertexId v : near) {
    const double weight = cosine(v) / std::max(away(v) * away(v), 1e-300);
    sum += mesh.vertex(v).irradiance * weight;
    weights += weight;
  }
  return sum / weights;
}

}  // namespace isolux
