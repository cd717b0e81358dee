#include "isolux/radiosity/bright_places.h"

#include <algorithm>
#include <array>
#include <cmath>

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
    node.cos_spread = std::min(node.cos_spread, dot(part.normal, node.axis));
  }
  node.sin_spread = std::sqrt(std::max(0.0, 1 - node.cos_spread * node.cos_spread));
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
    // Of half the angle that its sphere fills, and of the largest angle between a normal and the
    // way to the receiver from anywhere within.
    const double sine = apart ? node.radius / away : 1, cosine = std::sqrt(1 - sine * sine);
    const bool all_round = node.cos_spread * cosine <= node.sin_spread * sine;
    const double turned = all_round ? 1 : node.sin_spread * cosine + node.cos_spread * sine;
    if (apart && dot(node.axis, towards) >= away * turned) continue;  // its back
    const double chord = apart ? sine * std::sqrt(2 / (1 + cosine)) : 2;
    if (chord <= fine || (node.second == 0 && apart)) {
      cones.push_back({towards / away, chord, node.radiosity});
    } else if (node.second != 0) {
      open[count++] = node.second;
      open[count++] = at + 1;
    }
  }
}

}  // namespace isolux
