#include "isolux/radiosity/energy.h"

namespace isolux {

Rgb unshot_radiosity(const Triangulation& mesh, const Triangle& triangle) {
  Rgb received;
  for (VertexId v : triangle.vertices) received += mesh.vertex(v).radiosity();
  return triangle.emission + received / 3 - triangle.shot;
}

Energy energy_of(const Triangulation& mesh) {
  Energy energy;
  double signed_unshot = 0, reflecting = 0;
  for (const Triangle& triangle : mesh.triangles()) {
    if (!triangle.alive) continue;
    const double unshot = luminance(unshot_radiosity(mesh, triangle)) * triangle.area;
    energy.emitted_flux += luminance(triangle.emission) * triangle.area;
    energy.unshot_flux += std::abs(unshot);
    energy.area += triangle.area;
    signed_unshot += unshot;
    for (VertexId v : triangle.vertices) {
      reflecting += luminance(mesh.vertex(v).reflectance) * triangle.area / 3;
    }
  }
  if (energy.area > 0) {
    energy.ambient_exitance = signed_unshot / energy.area / (1 - reflecting / energy.area);
  }
  return energy;
}

}  // namespace isolux
