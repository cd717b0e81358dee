#include "isolux/radiosity/direct_light.h"

#include <algorithm>
#include <cmath>

#include "isolux/core/parallel.h"
#include "isolux/radiosity/light_lattice.h"
#include "isolux/radiosity/light_view.h"
#include "isolux/radiosity/separate_lights.h"
#include "isolux/radiosity/source_light.h"
#include "isolux/radiosity/spatial_order.h"

namespace isolux {
namespace {

using Index = std::uint32_t;

/// How many neighbours share shafts and doubts.
constexpr std::size_t kGroup = 8;

/// The receivers in an order in which those that face alike and stand close together are
/// neighbours.
std::vector<Index> in_groups(std::span<const Receiver> receivers) {
  std::array<std::vector<Index>, 6> facing;  // by the axis that the normal is nearest to
  for (Index i = 0; i < receivers.size(); ++i) {
    const Vec3& n = receivers[i].normal;
    int axis = 0;
    for (int k = 1; k < 3; ++k) axis = std::abs(n[k]) > std::abs(n[axis]) ? k : axis;
    facing[static_cast<std::size_t>(2 * axis + (n[axis] < 0))].push_back(i);
  }
  std::vector<Index> order;
  std::vector<Vec3> points;
  for (const std::vector<Index>& alike : facing) {
    points.clear();
    for (const Index i : alike) points.push_back(receivers[i].point);
    for (const Index k : z_order(points)) order.push_back(alike[k]);
  }
  return order;
}

}  // namespace

DirectLight::DirectLight(const RayCaster& rays)
    : rays_(rays), separate_(separate_lights(rays.scene())) {
  const Scene& scene = rays.scene();
  for (Index i = 0; i < scene.objects.size(); ++i) {
    if (separate_[i]) lights_.push_back(lattice_of(scene, i, rays.epsilon()));
  }
}

void DirectLight::irradiance(std::span<const Receiver> receivers, std::span<Rgb> irradiance,
                             std::span<double> error, double tolerance,
                             const std::function<bool()>& keep_going) const {
  const std::vector<Index> order = in_groups(receivers);
  const Precision precision = Precision::of(tolerance);
  const auto light_group = [&](std::span<const Index> members) {
    const std::size_t n = members.size();
    std::array<Receiver, kGroup> group;
    std::array<Rgb, kGroup> sum{};
    std::array<double, kGroup> variance{};
    for (std::size_t i = 0; i < n; ++i) group[i] = receivers[members[i]];
    LightView view(rays_, precision);
    for (const auto& light : lights_) {
      view.light_up(*light, std::span(group).first(n), sum, variance);
    }
    for (const Source& source : rays_.scene().sources) {
      add_source_light(rays_, source, std::span(group).first(n), sum);
    }
    for (std::size_t i = 0; i < n; ++i) {
      irradiance[members[i]] = sum[i];
      error[members[i]] = std::sqrt(variance[i]);
    }
  };
  constexpr std::size_t kBetweenLooks = 64 * kGroup;
  for (std::size_t first = 0; first < order.size(); first += kBetweenLooks) {
    if (keep_going && !keep_going()) return;
    const auto some =
        std::span(order).subspan(first, std::min(kBetweenLooks, order.size() - first));
    parallel_for(some.size(), kGroup, [&](std::size_t begin, std::size_t end) {
      light_group(some.subspan(begin, end - begin));
    });
  }
}

}  // namespace isolux
