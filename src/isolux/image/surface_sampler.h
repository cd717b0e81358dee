#pragma once

#include <optional>
#include <vector>

#include "isolux/discretization/mesh_lookup.h"
#include "isolux/discretization/mesh_rays.h"
#include "isolux/radiosity/form_factor.h"
#include "isolux/radiosity/pairing.h"
#include "isolux/raycast/ray_caster.h"
#include "isolux/solution/solution.h"

namespace isolux {

/// How the light of a sample was found (§3.3.1).
enum class SampleKind {
  interpolated,  ///< in the triangle paired with the surface
  extrapolated,  ///< from vertices around it, no triangle being there
  dark,          ///< the black back of a surface, or no vertex near enough
  background,    ///< the ray left the scene
};

/// What a ray sees.
struct SurfaceSample {
  SampleKind kind = SampleKind::background;
  Rgb exitance;  ///< lm/m²: emitted and reflected by the true surface
  /// Of a solution by gathering, where light was found: the point, its reflectance, and the
  /// vertices that its light is interpolated from.
  Receiver receiver = {};
  Rgb reflectance = {};
  std::optional<MeshPlace> place = {};
};

/// Looks at the true surfaces of a solution under the light of its triangulation, which it never
/// changes. The solution must outlive it. May be asked from many threads at once, each with a
/// scratch of its own.
class SurfaceSampler {
 public:
  explicit SurfaceSampler(const Solution& solution);

  struct Scratch {
    std::vector<MeshHit> hits;
    std::vector<HitPair> pairs;
    std::vector<VertexId> near;
  };

  const RayCaster& rays() const { return rays_; }

  /// `ray` has a direction of length 1.
  SurfaceSample sample(const Ray& ray, Scratch& scratch) const;

  /// Where `ray`, of a direction of length 1, meets the triangle that is paired with the surface it
  /// sees (§4); nothing where none is, or the surface is black.
  std::optional<MeshHit> triangle(const Ray& ray, Scratch& scratch) const;

 private:
  std::optional<MeshHit> paired(const Ray& ray, const SurfaceHit& hit, Scratch& scratch) const;
  std::optional<Rgb> extrapolated(const SurfacePoint& point, Scratch& scratch) const;
  SurfaceSample looked_up(const SurfaceHit& hit) const;
  std::optional<Rgb> stand_ins(const SurfacePoint& point, std::vector<VertexId>& near) const;

  const Solution& solution_;
  RayCaster rays_;
  MeshRays mesh_rays_;
  VertexGrid vertices_;
  /// Of a mesh by gathering, which looked light up in this way too.
  std::optional<MeshLookup> lookup_;
};

}  // namespace isolux
