#include "isolux/image/resample.h"

#include <array>
#include <atomic>
#include <memory>
#include <numbers>

#include "isolux/core/error.h"
#include "isolux/image/direct_finish.h"
#include "isolux/image/surface_sampler.h"

namespace isolux {
namespace {

using Totals = std::array<std::atomic<std::uint64_t>, 4>;

/// Shades one row and adds its counts to the totals at the end.
class RowShader {
 public:
  /// `direct`: nothing where light is interpolated as it is.
  RowShader(const SurfaceSampler& sampler, const DirectFinish* direct, Totals& totals)
      : sampler_(sampler), direct_(direct), totals_(totals) {}
  ~RowShader() {
    for (std::size_t kind = 0; kind < counts_.size(); ++kind) totals_[kind] += counts_[kind];
  }
  RowShader(const RowShader&) = delete;
  RowShader& operator=(const RowShader&) = delete;

  Rgb shade(std::span<const Ray> rays) {
    samples_.clear();
    for (const Ray& ray : rays) {
      samples_.push_back(sampler_.sample(ray, scratch_));
      ++counts_[static_cast<std::size_t>(samples_.back().kind)];
    }
    if (direct_) direct_->apply(samples_);
    Rgb sum;
    for (const SurfaceSample& sample : samples_) sum += sample.exitance / std::numbers::pi;
    return sum / static_cast<double>(rays.size());
  }

 private:
  const SurfaceSampler& sampler_;
  const DirectFinish* direct_;
  Totals& totals_;
  std::vector<SurfaceSample> samples_;
  SurfaceSampler::Scratch scratch_;
  std::array<std::uint64_t, 4> counts_{};
};

}  // namespace

Rendering render(const Solution& solution, const Camera& camera, const RenderOptions& options) {
  if (options.direct && solution.options.method != Method::gathering) {
    throw InputError("direct light can be gathered anew for solutions of the default method alone");
  }
  const SurfaceSampler sampler(solution);
  std::optional<DirectFinish> direct;
  if (options.direct) direct.emplace(solution, sampler.rays());
  Totals totals{};
  Rendering rendering;
  rendering.picture = supersample(camera, options, [&]() -> Shade {
    const auto row = std::make_shared<RowShader>(sampler, direct ? &*direct : nullptr, totals);
    return [row](std::span<const Ray> rays, double) { return row->shade(rays); };
  });
  const auto total = [&](SampleKind kind) { return totals[static_cast<std::size_t>(kind)].load(); };
  rendering.samples = {total(SampleKind::interpolated), total(SampleKind::extrapolated),
                       total(SampleKind::dark), total(SampleKind::background)};
  return rendering;
}

}  // namespace isolux
