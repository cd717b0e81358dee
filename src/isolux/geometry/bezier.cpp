#include "isolux/geometry/bezier.h"

#include <fmt/format.h>

#include "isolux/core/error.h"
#include "isolux/geometry/shape_description.h"

namespace isolux {

Bezier::Bezier(std::vector<Points> patches)
    : PatchSurface(control_points(patches), "patches", Degenerate::refused),
      given_(std::move(patches)) {}

std::vector<PatchSurface::ControlPoints> Bezier::control_points(
    const std::vector<Points>& patches) {
  std::vector<ControlPoints> all;
  for (const Points& points : patches) {
    ControlPoints& patch = all.emplace_back();
    if (points.size() != patch.size()) {
      throw InputError(fmt::format("patches: each has 16 points, not {}", points.size()));
    }
    for (std::size_t i = 0; i < patch.size(); ++i) patch[i] = {points[i], 1};
  }
  return all;
}

ShapeDescription Bezier::describe() const {
  return {"bezier", {{"patches", ShapeDescription::Outlines(given_)}}, {}, {}};
}

}  // namespace isolux
