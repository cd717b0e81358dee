#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/discretization/triangulation.h"

namespace isolux {

/// A triangle of the mesh, as it is or once was, and whose surface rays met over it.
struct Site {
  /// Which entry of the surfaces' table: 3 × object, + 1 on its back, which does not emit, + 2
  /// where it only emits, the mesh having no vertex there; then an entry for what is black, because
  /// it faces away, and last one for the outside: dark, or the sky.
  std::uint32_t surface = 0;
  std::array<VertexId, 3> vertices{};

  bool operator==(const Site&) const = default;
};

/// Of a site's second and third vertex, in units of 1 / 65535; the first has the rest.
using SiteWeights = std::array<std::uint16_t, 2>;
inline constexpr double kSiteWeightUnit = 1.0 / 65535;

/// Where a ray landed, as it is kept: 8 bytes.
struct Link {
  std::uint32_t site = 0;  ///< in a table of sites
  SiteWeights weights{};
};
static_assert(sizeof(Link) == 8);

/// Sites, each listed once. Many rays land in the same triangle.
class SiteTable {
 public:
  std::span<const Site> sites() const { return sites_; }

  /// The site's number; nothing where it is not listed. May be asked from many threads at once.
  std::optional<std::uint32_t> find(const Site& site) const;

  /// The site's number; it is listed if it was not.
  std::uint32_t add(const Site& site);

 private:
  std::size_t slot_of(const Site& site) const;
  void grow();

  std::vector<Site> sites_;
  std::vector<std::uint32_t> slots_;  // hash table of numbers + 1; 0: free
};

/// The radiosity over a site, lm/m²: at its first vertex, and how much more at the second and
/// third. In single precision, so that many stay in the cache.
struct SiteLight {
  std::array<float, 3> first, second, third;  // r, g, b

  Rgb at(const SiteWeights& weights) const {
    const double s = weights[0] * kSiteWeightUnit, t = weights[1] * kSiteWeightUnit;
    const auto channel = [&](std::size_t c) {
      return double(first[c]) + double(second[c]) * s + double(third[c]) * t;
    };
    return {channel(0), channel(1), channel(2)};
  }
};

}  // namespace isolux
