#include "isolux/image/resample.h"

#include <array>
#include <atomic>
#include <memory>
#include <numbers>

#include "isolux/image/surface_sampler.h"

namespace isolux {
namespace {

using Totals = std::array<std::atomic<std::uint64_t>, 4>;

/// Shades one row and adds its counts to the totals at the end.
class RowShader {
 public:
  RowShader(const SurfaceSampler& sampler, Totals& totals) : sampler_(sampler), totals_(totals) {}
  ~RowShader() {
    for (std::size_t kind = 0; kind < counts_.size(); ++kind) totals_[kind] += counts_[kind];
  }
  RowShader(const RowShader&) = delete;
  RowShader& operator=(const RowShader&) = delete;

  Rgb shade(const Ray& ray) {
    const SurfaceSample sample = sampler_.sample(ray, scratch_);
    ++counts_[static_cast<std::size_t>(sample.kind)];
    return sample.exitance / std::numbers::pi;
  }

 private:
  const SurfaceSampler& sampler_;
  Totals& totals_;
  SurfaceSampler::Scratch scratch_;
  std::array<std::uint64_t, 4> counts_{};
};

}  // namespace

Rendering render(const Solution& solution, const Camera& camera, const RenderOptions& options) {
  const SurfaceSampler sampler(solution);
  Totals totals{};
  Rendering rendering;
  rendering.picture = supersample(camera, options, [&]() -> Shade {
    const auto row = std::make_shared<RowShader>(sampler, totals);
    return [row](const Ray& ray, double) { return row->shade(ray); };
  });
  const auto total = [&](SampleKind kind) { return totals[static_cast<std::size_t>(kind)].load(); };
  rendering.samples = {total(SampleKind::interpolated), total(SampleKind::extrapolated),
                       total(SampleKind::dark), total(SampleKind::background)};
  return rendering;
}

}  // namespace isolux
