#include "isolux/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "isolux/core/error.h"
#include "isolux/scene/spelling.h"

namespace isolux {

Bounds Scene::bounds() const {
  Bounds all;
  for (const Object& object : objects) all.include(object.shape->bounds());
  return all;
}

bool Scene::has_light() const {
  return (sky && sky->shines()) ||
         std::any_of(objects.begin(), objects.end(), [](const Object& o) { return o.emits(); }) ||
         std::any_of(sources.begin(), sources.end(),
                     [](const Source& s) { return max_channel(s.intensity) > 0; });
}

const Camera& Scene::camera(const std::string& wanted) const {
  if (cameras.empty()) {
    throw InputError("the scene has no camera: add one under 'cameras' to its file");
  }
  if (wanted.empty()) return cameras.front();
  std::vector<std::string_view> names;
  for (const Camera& camera : cameras) {
    if (camera.name == wanted) return camera;
    names.push_back(camera.name);
  }
  throw InputError(fmt::format("no camera is named {}: there {} {}", in_quotes(wanted),
                               names.size() == 1 ? "is" : "are", enumerated(names)));
}

std::optional<double> surface_area(const Shape& shape) {
  if (const std::optional<double> known = shape.area()) return known;
  const std::optional<TriangleSoup> soup = shape.triangulate(shape.bounds().diagonal());
  if (!soup) return std::nullopt;
  double area = 0;
  for (const auto& [a, b, c] : soup->triangles) {
    const Vec3& corner = soup->points[a];
    area += 0.5 * length(cross(soup->points[b] - corner, soup->points[c] - corner));
  }
  return area;
}

double luminous_flux(const Object& object) {
  return object.emits() ? luminance(object.exitance) * surface_area(*object.shape).value_or(0) : 0;
}

}  // namespace isolux
