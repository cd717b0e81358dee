#include "isolux/radiosity/illumination.h"

#include <algorithm>
#include <cmath>

#include "isolux/core/parallel.h"
#include "isolux/radiosity/direct_light.h"
#include "isolux/radiosity/hemisphere_gather.h"

namespace isolux {

std::vector<Illumination> gather_at(const Triangulation& mesh, const RayCaster& rays,
                                    const Statistics& solved, std::span<const Receiver> receivers,
                                    std::uint64_t seed) {
  constexpr std::size_t kGrain = 64;
  const DirectLight lights(rays);
  const HemisphereGather hemisphere(rays, mesh, lights.separate());
  std::vector<Rgb> irradiance, errors;
  for (const Vertex& vertex : mesh.vertices()) {
    irradiance.push_back(vertex.mean_irradiance);
    errors.push_back(gray(vertex.error));
  }
  std::vector<Rgb> direct(receivers.size());
  std::vector<double> deviation(receivers.size());
  lights.irradiance(receivers, direct, deviation);

  // Few points deserve more rays than each of very many vertices.
  constexpr double kFinerGrid = 1.5;
  const int grid =
      std::clamp(static_cast<int>(std::lround(kFinerGrid * std::sqrt(solved.gather_rays))), 1,
                 HemisphereGather::kFinestGrid);
  std::vector<Illumination> result(receivers.size());
  parallel_for(receivers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Landing> row(static_cast<std::size_t>(grid) * static_cast<std::size_t>(grid));
    for (std::size_t i = begin; i < end; ++i) {
      hemisphere.trace(receivers[i], grid, seed, i, row);
      const Gathered indirect = hemisphere.gather_with_error(row, irradiance);
      result[i].irradiance = direct[i] + indirect.irradiance;
      const double emitters = luminance(hemisphere.reflected(row, errors));
      result[i].error =
          std::hypot(kConfidence * std::hypot(deviation[i], indirect.error), emitters) +
          solved.emitter_error;
    }
  });
  return result;
}

}  // namespace isolux
