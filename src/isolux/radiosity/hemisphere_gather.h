#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/discretization/mesh_lookup.h"
#include "isolux/radiosity/bright_places.h"
#include "isolux/radiosity/links.h"
#include "isolux/radiosity/row.h"
#include "isolux/radiosity/sky_dome.h"
#include "isolux/radiosity/visibility.h"

namespace isolux {

class HemisphereRays;

/// Where a ray over a hemisphere lands: a place in the mesh, and whose surface it is.
struct Landing {
  Site site;
  SiteWeights weights{};
};

/// Irradiance with its error.
struct Gathered {
  Rgb irradiance;    ///< lx
  double error = 0;  ///< one standard deviation of its luminance, lx
};

/// Light gathered by rays over the hemisphere (the paper's rays turned round): each ray finds the
/// true surface, and the radiosity there is ρ E, E interpolated in the mesh, plus the emission of
/// objects that are not lights of their own; a ray that leaves the scene brings the light of its
/// sky. Where the rays land is kept, so that transport is repeated without rays while E changes.
///
/// The directions are those of a square of grid × grid cells, one point jittered in each, mapped to
/// the disk (Shirley & Chiu 1997), turned by an angle of the receiver's own and lifted to the
/// hemisphere (Malley 1988): the density goes with the cosine, and all cells weigh the same. Cells
/// in which places may lie that are far brighter than the receiver, such as a lamp's reflector,
/// are divided, so that no ray carries a large part of the light.
class HemisphereGather {
 public:
  /// The most cells that a solve asks for.
  static constexpr int kFinestGrid = 256;

  /// `separate`, by object: 1 where its emission is left out here because it is gathered as a
  /// light (separate_lights()). `rays` and `mesh` must outlive this; triangles
  /// that the mesh gets later are not seen, but vertices stay valid. No cell is divided unless
  /// `irradiance` (lx, at the mesh's vertices) tells where it is bright.
  HemisphereGather(const RayCaster& rays, const Triangulation& mesh,
                   std::span<const std::uint8_t> separate, std::span<const Rgb> irradiance = {});

  /// Whether cells at the rims of what is seen of the sky are divided.
  enum class Rims { divided, as_they_are };

  /// The row of one receiver: where its rays land. The same seed and id give the same directions.
  void trace(const Receiver& receiver, int grid, std::uint64_t seed, std::uint64_t id,
             Row<Landing>& row, Rims rims = Rims::divided) const;

  /// The part of gather() that is reflected, without what the surfaces emit by themselves.
  Rgb reflected(const Row<Landing>& row, std::span<const Rgb> irradiance) const;

  /// Whether no light is sent back from there: what leaves the scene, or meets a black back.
  bool lost(const Site& site) const { return site.surface >= surfaces_.size() - 2; }

  /// Site::surface is less than this.
  static std::size_t surface_count(const Scene& scene) { return 3 * scene.objects.size() + 2; }

  /// Site::surface of what leaves the scene; where that has a sky, the vertices are SkyDome's
  /// nodes.
  static std::uint32_t outside_of(const Scene& scene) {
    return static_cast<std::uint32_t>(surface_count(scene) - 1);
  }

  /// The irradiance that the row's surfaces give with `irradiance` (lx) at the mesh's vertices.
  Rgb gather(const Row<Landing>& row, std::span<const Rgb> irradiance) const;

  /// The same with the error of having only so many rays, from the second differences between
  /// neighbouring cells: (f₋ − 2f + f₊)² / 6 is on average the variance of a jittered point in the
  /// middle cell where the radiosity is linear, and not less elsewhere; within divided cells
  /// likewise. Of a grid of less than 3 cells a side, the error is the spread of all its rays.
  Gathered gather_with_error(const Row<Landing>& row, std::span<const Rgb> irradiance) const;

  /// What sites send out with `irradiance` (lx) at the mesh's vertices, for the two below.
  SiteLight light_of(const Site& site, std::span<const Rgb> irradiance) const;

 private:
  bool shows_sky(const Site& site) const { return sky_ && site.surface == surfaces_.size() - 1; }

  static Landing landing_at(std::uint32_t surface, const MeshPlace& place);

  /// Where rays start, and the darkest place there as the mesh has it, once it was looked for.
  struct Origin {
    const Receiver& receiver;
    bool looked = false;
    std::optional<MeshPlace> own = {};
  };

  /// Where a ray from there lands, by what it meets first, and the triangle over that.
  Landing landing_of(Origin& origin, const Ray& ray, const std::optional<SurfaceHit>& hit,
                     const std::optional<MeshPlace>& covering) const;
  std::optional<MeshPlace> place_of(Origin& origin, const SurfaceHit& hit,
                                    const std::optional<MeshPlace>& covering) const;
  MeshPlace darkest_of(const MeshPlace& place) const;
  bool much_closer(const Origin& origin, const SurfaceHit& hit, const MeshPlace& place,
                   bool covered) const;
  void find_bright_places(const Triangulation& mesh, std::span<const std::uint8_t> separate,
                          std::span<const Rgb> irradiance);
  void divide(const Receiver& receiver, const HemisphereRays& rays, Row<Landing>& row) const;
  void divide_rims(Row<Landing>& row) const;
  void land(Origin& origin, std::span<const Ray> rays, std::size_t first, Row<Landing>& row) const;
  double expected_at(const Receiver& receiver) const;

  /// What a surface does to light.
  struct Surface {
    Rgb reflectance;
    Rgb emission;  ///< lm/m²
  };

  const RayCaster& rays_;
  const Triangulation& mesh_;
  MeshLookup lookup_;
  std::vector<Surface> surfaces_;  // by Site::surface
  std::optional<SkyDome> sky_;
  BrightPlaces bright_;
  std::vector<float> irradiance_;  // by vertex, lx; empty where it is not known
  double mean_irradiance_ = 0;     // lx
};

/// HemisphereGather::gather() of a row that is kept, from the light of all sites.
Rgb gather(const Row<Link>& row, std::span<const SiteLight> sites);

/// HemisphereGather::gather_with_error() of a row that is kept.
Gathered gather_with_error(const Row<Link>& row, std::span<const SiteLight> sites);

}  // namespace isolux
