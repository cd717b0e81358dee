#pragma once

#include <vector>

#include "isolux/core/color.h"
#include "isolux/discretization/triangulation.h"

namespace isolux {

/// A living triangle as the classic methods see it: constant reflectance and radiosity.
struct Element {
  TriangleId triangle = 0;
  double area = 0;  ///< m²
  Rgb reflectance;
  Rgb emission;  ///< lm/m²
};

inline std::vector<Element> elements_of(const Triangulation& mesh) {
  std::vector<Element> elements;
  for (TriangleId id = 0; id < mesh.triangles().size(); ++id) {
    const Triangle& triangle = mesh.triangle(id);
    if (!triangle.alive) continue;
    Rgb reflectance;
    for (VertexId v : triangle.vertices) reflectance += mesh.vertex(v).reflectance / 3;
    elements.push_back({id, triangle.area, reflectance, triangle.emission});
  }
  return elements;
}

}  // namespace isolux
