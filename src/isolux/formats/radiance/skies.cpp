#include "isolux/formats/radiance/skies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/formats/limits.h"

namespace isolux::radiance {
namespace {

constexpr double kSlack = 1e-6;         ///< degrees, of the widths of hemispheres
constexpr double kParallel = 1 - 1e-6;  ///< cosine of what counts as the same direction
constexpr std::size_t kMostSources = 1000;

void require_dim(const Rgb& luminance, const SourceLocation& place) {
  if (max_channel(luminance) <= kBrightestSky) return;
  throw InputError(place, fmt::format("this sky would be brighter than {:g} cd/m²", kBrightestSky));
}

}  // namespace

void Skies::add(const Vec3& toward, double angle, const SourceLight& light,
                const SourceLocation& place) {
  const bool whole = angle > 360 - kSlack;
  if (!whole && std::abs(angle - 180) > kSlack) {
    notes_.left_out("source",
                    "wider than 10 degrees, but neither half (180) nor all (360) of the sky");
    return;
  }
  if (light.pattern.other) {
    notes_.left_out("source",
                    "its pattern is none of the skies skybr (skybright.cal) and "
                    "skybright (perezlum.cal)");
    return;
  }
  if (sources_.size() == kMostSources) {
    throw InputError(place,
                     fmt::format("more than {} sources are wider than 10 degrees", kMostSources));
  }
  sources_.push_back({toward, whole, light, place});
}

Vec3 Skies::up() const {
  for (const Source& source : sources_) {
    if (!source.light.pattern.sky) continue;
    const Vec3& up = source.light.pattern.sky->up;
    if (source.whole || std::abs(dot(source.toward, up)) > kParallel) return up;
  }
  const Source& first = sources_.front();
  if (first.whole) return {0, 0, 1};
  // The ground is the hemisphere that lies down an axis.
  const Vec3& d = first.toward;
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  const double most = z >= std::max(x, y) ? d.z : y >= x ? d.y : d.x;
  return most < 0 ? -d : d;
}

std::optional<Sky> Skies::sky_of(const Source& source) const {
  const Rgb& luminance = source.light.luminance;
  const SkyPattern* const pattern = source.light.pattern.sky.get();
  if (!pattern) {
    Sky uniform;
    uniform.zenith = uniform.ground = luminance;
    return uniform;
  }
  const auto patterned = radiance::sky_of(*pattern);
  if (!patterned) {
    notes_.left_out("source", "its sky is darker than 0 in places, or not finite");
    return std::nullopt;
  }
  if (pattern->colored) {
    notes_.add("'perezlum_c.cal': its color goes with the luminance; the sky is plain");
  }
  if (patterned->nearest_type > 0) {
    notes_.add(
        fmt::format("the intermediate sky: the CIE sky of type {} is nearest, and gives the same "
                    "illuminance",
                    patterned->nearest_type));
  }
  Sky sky = patterned->sky;
  sky.zenith = luminance * sky.zenith;
  sky.ground = luminance * sky.ground;
  return sky;
}

std::optional<Sky> Skies::sky() const {
  if (sources_.empty()) return std::nullopt;
  Sky sky;
  sky.up = sky.sun = up();
  bool has_zenith = false, has_ground = false;
  for (const Source& source : sources_) {
    const SkyPattern* const pattern = source.light.pattern.sky.get();
    const double along = dot(source.toward, sky.up);
    if ((pattern && dot(pattern->up, sky.up) < kParallel) ||
        (!source.whole && std::abs(along) < kParallel)) {
      notes_.left_out("source", "its horizon is not that of the sky");
      continue;
    }
    const bool above = source.whole || along > 0, below = source.whole || along < 0;
    if ((above && has_zenith) || (below && has_ground)) {
      notes_.left_out("source", "a second sky over the first");
    }
    const bool makes_zenith = above && !has_zenith, makes_ground = below && !has_ground;
    if (!makes_zenith && !makes_ground) continue;
    const auto own = sky_of(source);
    if (!own) continue;
    if (makes_zenith) {
      has_zenith = true;
      sky.distribution = own->distribution;
      sky.sun = pattern ? own->sun : sky.up;
      sky.zenith = own->zenith;
      require_dim(sky.zenith * relative_range(sky.distribution, dot(sky.sun, sky.up)).most,
                  source.place);
    }
    if (makes_ground) {
      has_ground = true;
      sky.ground = own->ground;
      require_dim(sky.ground, source.place);
    }
  }
  return sky.shines() ? std::optional(sky) : std::nullopt;
}

}  // namespace isolux::radiance
