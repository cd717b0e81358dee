#include "isolux/radiosity/bright_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace isolux {

struct BrightPlaces::Part {
  std::array<Vec3, 3> corners;
  Vec3 normal, center;
  double radiosity;
};

BrightPlaces::BrightPlaces(const Triangulation& mesh, std::span<const double> radiosity,
                           double least) {
  std::vector<Part> parts;
  for (TriangleId id = 0; id < mesh.triangles().size(); ++id) {
    const Triangle& triangle = mesh.triangle(id);
    if (!triangle.alive || !(radiosity[id] > least)) continue;
    Part part{{}, triangle.normal, {}, radiosity[id]};
    for (std::size_t k = 0; k < 3; ++k) {
      part.corners[k] = mesh.vertex(triangle.vertices[k]).position;
      part.center += part.corners[k] / 3;
    }
    parts.push_back(part);
  }
  if (!parts.empty()) add(parts);
}

/// Adds the tree over these: halved at the median along the longest side.
void BrightPlaces::add(std::span<Part> parts) {
  Node node;
  Bounds box, centers;
  Vec3 normals;
  for (const Part& part : parts) {
    for (const Vec3& corner : part.corners) box.include(corner);
    centers.include(part.center);
    normals += part.normal;
    node.radiosity = std::max(node.radiosity, part.radiosity);
  }
  node.center = box.center();
  const double size = length(normals);
  node.axis = size > 0 ? normals / size : parts[0].normal;
  for (const Part& part : parts) {
    for (const Vec3& corner : part.corners) {
      node.radius = std::max(node.radius, distance(corner, node.center));
    }
    node.spread =
        std::max(node.spread, std::acos(std::clamp(dot(part.normal, node.axis), -1.0, 1.0)));
  }
  const std::size_t at = nodes_.size();
  nodes_.push_back(node);
  if (parts.size() == 1) return;
  const Vec3 extent = centers.upper - centers.lower;
  int axis = 0;
  for (int k = 1; k < 3; ++k) axis = extent[k] > extent[axis] ? k : axis;
  const auto middle = parts.begin() + static_cast<std::ptrdiff_t>(parts.size() / 2);
  std::nth_element(parts.begin(), middle, parts.end(),
                   [&](const Part& a, const Part& b) { return a.center[axis] < b.center[axis]; });
  add(parts.first(parts.size() / 2));
  nodes_[at].second = static_cast<std::uint32_t>(nodes_.size());
  add(parts.subspan(parts.size() / 2));
}

void BrightPlaces::seen_from(const Vec3& point, const Vec3& normal, double least, double fine,
                             std::vector<Cone>& cones) const {
  cones.clear();
  if (nodes_.empty()) return;
  std::array<std::uint32_t, 64> open;  // deeper than any tree gets
  std::size_t count = 0;
  open[count++] = 0;
  while (count > 0) {
    const std::uint32_t at = open[--count];
    const Node& node = nodes_[at];
    if (node.radiosity <= least) continue;
    const Vec3 towards = node.center - point;
    if (dot(towards, normal) <= -node.radius) continue;  // below the horizon
    const double away = length(towards);
    const bool apart = away > node.radius;
    const double half_angle = apart ? std::asin(node.radius / away) : std::numbers::pi;
    const double turned = std::min(node.spread + half_angle, std::numbers::pi / 2);
    if (apart && dot(node.axis, towards) >= away * std::sin(turned)) continue;  // its back
    const double chord = 2 * std::sin(half_angle / 2);
    if (chord <= fine || (node.second == 0 && apart)) {
      cones.push_back({towards / away, chord, node.radiosity});
    } else if (node.second != 0) {
      open[count++] = node.second;
      open[count++] = at + 1;
    }
  }
}

}  // namespace isolux
