#include "isolux/image/direct_finish.h"

#include <algorithm>

namespace isolux {

DirectFinish::DirectFinish(const Solution& solution, const RayCaster& rays)
    : lights_(rays), direct_(solution.mesh.vertices().size()) {
  const auto vertices = solution.mesh.vertices();
  std::vector<Receiver> receivers;
  for (const Vertex& v : vertices) {
    receivers.push_back({v.gather_point, v.normal});
    hidden_.push_back(v.hidden);
  }
  std::vector<double> deviation(receivers.size());
  lights_.irradiance(receivers, direct_, deviation);
}

void DirectFinish::apply(std::span<SurfaceSample> samples) const {
  std::vector<SurfaceSample*> lit;
  std::vector<Receiver> receivers;
  for (SurfaceSample& sample : samples) {
    if (!sample.place || sample.reflectance == Rgb{}) continue;
    lit.push_back(&sample);
    receivers.push_back(sample.receiver);
  }
  std::vector<Rgb> irradiance(lit.size());
  std::vector<double> deviation(lit.size());
  lights_.irradiance(receivers, irradiance, deviation);
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const auto& [vertices, weights] = *lit[i]->place;
    // Hidden vertices have the E_d of places beside them: that of the others tells.
    Rgb interpolated;
    double seen = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (hidden_[vertices[k]]) continue;
      interpolated += direct_[vertices[k]] * weights[k];
      seen += weights[k];
    }
    if (seen > 0) interpolated = interpolated / seen;
    const Rgb exitance = lit[i]->exitance + lit[i]->reflectance * (irradiance[i] - interpolated);
    lit[i]->exitance = {std::max(exitance.r, 0.0), std::max(exitance.g, 0.0),
                        std::max(exitance.b, 0.0)};
  }
}

}  // namespace isolux
