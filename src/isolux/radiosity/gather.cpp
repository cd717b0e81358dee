#include "isolux/radiosity/gather.h"

#include <algorithm>
#include <vector>

#include "isolux/core/parallel.h"

namespace isolux {

void gather_irradiance(const Triangulation& mesh, const RayCaster& rays,
                       std::span<const Receiver> receivers, int subdivisions,
                       std::span<Rgb> irradiance) {
  constexpr std::size_t kGrain = 64;
  parallel_for(receivers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    const auto group = receivers.subspan(begin, end - begin);
    const auto sums = irradiance.subspan(begin, end - begin);
    std::fill(sums.begin(), sums.end(), Rgb{});
    std::vector<double> factors(group.size());
    for (TriangleId id = 0; id < mesh.triangles().size(); ++id) {
      const Triangle& triangle = mesh.triangle(id);
      if (!triangle.alive) continue;
      Rgb radiosity = triangle.emission;
      for (VertexId v : triangle.vertices) radiosity += mesh.vertex(v).radiosity() / 3;
      if (radiosity == Rgb{}) continue;
      visible_form_factors(rays, emitter_of(mesh, id), group, subdivisions, factors);
      for (std::size_t i = 0; i < group.size(); ++i) sums[i] += radiosity * factors[i];
    }
  });
}

}  // namespace isolux
