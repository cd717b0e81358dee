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
  std::vector<Rgb> irradiance, errors;
  for (const Vertex& vertex : mesh.vertices()) {
    irradiance.push_back(vertex.mean_irradiance);
    errors.push_back(gray(vertex.error));
  }
  const HemisphereGather hemisphere(rays, mesh, lights.separate(), irradiance);
  std::vector<Rgb> direct(receivers.size());
  std::vector<double> deviation(receivers.size());
  lights.irradiance(receivers, direct, deviation);

  // Few points deserve more rays than each of very many vertices; where little light comes from
  // small parts of the hemisphere, up to twice as many a side, twice over.
  constexpr double kFinerGrid = 1.5;
  constexpr double kMostRough = 0.02, kLeastRough = 0.002;  // σ in parts of E
  const double rough = std::clamp(solved.error, kLeastRough, kMostRough);
  constexpr int kDoublings = 2;
  // Of what the errors of all emitters would sum up to, were they alike: some cancel.
  constexpr double kAlike = 0.7;
  // Short of its tolerance, a solution may have made or lost light where it is still rough.
  const double unbalanced = solved.converged || !(solved.emitted_flux > 0)
                                ? 0
                                : std::abs(solved.imbalance) / solved.emitted_flux;
  const int grid =
      std::clamp(static_cast<int>(std::lround(kFinerGrid * std::sqrt(solved.gather_rays))), 1,
                 HemisphereGather::kFinestGrid);
  std::vector<Illumination> result(receivers.size());
  parallel_for(receivers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Row<Landing> row;
    for (std::size_t i = begin; i < end; ++i) {
      Gathered indirect;
      for (int side = grid, finest = std::min(grid << kDoublings, HemisphereGather::kFinestGrid);;
           side = std::min(2 * side, finest)) {
        hemisphere.trace(receivers[i], side, seed, i, row);
        indirect = hemisphere.gather_with_error(row, irradiance);
        result[i].irradiance = direct[i] + indirect.irradiance;
        if (side == finest || indirect.error <= rough * luminance(result[i].irradiance)) break;
      }
      const double emitters = luminance(hemisphere.reflected(row, errors));
      result[i].error =
          std::hypot(kConfidence * std::hypot(deviation[i], indirect.error), kAlike * emitters) +
          solved.emitter_error + unbalanced * luminance(result[i].irradiance);
    }
  });
  return result;
}

}  // namespace isolux
