#include "isolux/radiosity/furnace.h"

#include <algorithm>
#include <cmath>

#include "isolux/core/error.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/reversed.h"

namespace isolux {
namespace {

constexpr double kMargin = 0.05;  // between the bounds and the box, of the scene's diagonal

/// Far from each other for neighbours in the list: multiples of the golden ratio, modulo 1.
double reflectance_of(std::size_t object) {
  constexpr double kLeast = 0.2, kMost = 0.8, kGoldenRatio = 0.6180339887498949;
  const double turns = kGoldenRatio * static_cast<double>(object);
  return kLeast + (kMost - kLeast) * (turns - std::floor(turns));
}

Object closing_box(const Bounds& bounds) {
  const Vec3 margin = Vec3{1, 1, 1} * (kMargin * bounds.diagonal());
  const auto box = std::make_shared<Box>(bounds.lower - margin, bounds.upper + margin);
  return {"the box around the scene", std::make_shared<Complement>(box), 0, Sides::front, {}};
}

}  // namespace

Scene furnace_scene(const Scene& scene, double exitance) {
  if (scene.objects.empty()) throw InputError("the scene has no objects");
  Scene furnace;
  furnace.name = scene.name;
  furnace.cameras = scene.cameras;
  furnace.objects = scene.objects;
  for (const Object& object : scene.objects) {
    if (object.shape->solid()) continue;
    Object back = object;
    back.name += " (back)";
    back.shape = std::make_shared<Reversed>(object.shape);
    furnace.objects.push_back(std::move(back));
  }
  furnace.objects.push_back(closing_box(scene.bounds()));
  const auto emits = [](const Object& object) { return object.emits(); };
  // Where there is a sky, light also reaches what lamps do not.
  const bool lit = !scene.sky && std::ranges::any_of(scene.objects, emits);
  for (std::uint32_t i = 0; i < furnace.objects.size(); ++i) {
    Object& object = furnace.objects[i];
    const double reflectance = reflectance_of(i);
    furnace.materials.push_back({object.name, gray(reflectance)});
    object.material = i;
    object.sides = Sides::front;
    object.glows = lit && !object.emits();
    object.exitance = gray(exitance * (1 - reflectance));
  }
  return furnace;
}

double FurnaceReport::unaccounted() const {
  return emitted_flux - absorbed_flux - escaped_flux - unshot_flux;
}

FurnaceReport judge_furnace(const Scene& furnace, const Triangulation& mesh,
                            const Statistics& statistics, double exitance) {
  FurnaceReport report;
  report.absorbed_flux = statistics.absorbed_flux;
  report.escaped_flux = statistics.escaped_flux;
  report.unshot_flux = statistics.unshot_flux;
  double squares = 0, area = 0;
  for (const Triangle& triangle : mesh.triangles()) {
    if (!triangle.alive) continue;
    for (const VertexId v : triangle.vertices) {
      const Vertex& vertex = mesh.vertex(v);
      const Rgb& emission = furnace.objects[vertex.surface.object].exitance;
      const double off = luminance(emission + vertex.radiosity()) / exitance - 1;
      const double part = triangle.area / 3;
      squares += off * off * part;
      area += part;
      report.emitted_flux += luminance(emission) * part;
      if (std::abs(off) > std::abs(report.worst)) {
        report.worst = off;
        report.place = vertex.position;
        report.object = vertex.surface.object;
      }
    }
  }
  report.rms = area > 0 ? std::sqrt(squares / area) : 0;
  return report;
}

}  // namespace isolux
