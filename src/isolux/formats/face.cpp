#include "isolux/formats/face.h"

#include <fmt/format.h>

#include <map>

#include "isolux/core/error.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/polygon.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux {
namespace {

constexpr std::size_t kMostCorners = 1000;  // of a Polygon
constexpr double kOffPlane = 1e-6;          // of the size, as a Polygon allows
constexpr double kTouching = 1e-9;          // of the size: as good as on a side

double size_of(const Contour& contour) {
  Bounds box;
  for (const Vec3& p : contour) box.include(p);
  return box.diagonal();
}

bool has_area(const Contour& contour) {
  const double size = size_of(contour);
  // Leaves a margin to what Polygon asks, which takes the same sum in another order.
  return size > kShortestLength && length(doubled_area(contour)) > 2e-12 * size * size;
}

/// The sides of a contour but for its seams, between places that are all different.
struct Sides {
  Contour places;
  std::multimap<std::size_t, std::size_t> leading_from;

  explicit Sides(const Contour& contour);
  void add(std::size_t from, std::size_t to);
  /// Takes out sides that lead from one to the next and back to the start. As many lead to a place
  /// as from it, so that there always is a next.
  Contour take_loop();
};

/// Adds a side, or takes away the one that runs the other way.
void Sides::add(std::size_t from, std::size_t to) {
  const auto [first, last] = leading_from.equal_range(to);
  for (auto side = first; side != last; ++side) {
    if (side->second != from) continue;
    leading_from.erase(side);
    return;
  }
  leading_from.emplace(from, to);
}

Sides::Sides(const Contour& contour) {
  const double slack = kTouching * size_of(contour);
  std::vector<std::size_t> numbers;
  for (const Vec3& p : contour) {
    std::size_t i = 0;
    while (i < places.size() && distance(places[i], p) > slack) ++i;
    if (i == places.size()) places.push_back(p);
    numbers.push_back(i);
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t from = numbers[i], to = numbers[(i + 1) % numbers.size()];
    if (from == to) continue;
    // A side is cut where other corners lie on it, so that parts of it can be seams.
    const Vec3 a = places[from], along = places[to] - a;
    std::map<double, std::size_t> stops;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double t = dot(places[k] - a, along) / length_squared(along);
      if (k != from && k != to && t > 0 && t < 1 && distance(places[k], a + along * t) <= slack) {
        stops.emplace(t, k);
      }
    }
    std::size_t last = from;
    for (const auto& [t, stop] : stops) {
      add(last, stop);
      last = stop;
    }
    add(last, to);
  }
}

Contour Sides::take_loop() {
  Contour loop;
  const std::size_t start = leading_from.begin()->first;
  std::size_t here = start;
  do {
    loop.push_back(places[here]);
    const auto side = leading_from.find(here);
    here = side->second;
    leading_from.erase(side);
  } while (here != start);
  return loop;
}

/// Each corner moved along the normal onto the plane through the outline's middle.
Region flattened(const Region& region, double& farthest) {
  const Vec3 normal = normalized(doubled_area(region.outline));
  Vec3 middle;
  for (const Vec3& p : region.outline) {
    middle += p / static_cast<double>(region.outline.size());
  }
  farthest = 0;
  Region flat = region;
  const auto flatten = [&](Contour& contour) {
    for (Vec3& p : contour) {
      const double height = dot(p - middle, normal);
      farthest = std::max(farthest, std::abs(height));
      p -= normal * height;
    }
  };
  flatten(flat.outline);
  for (Contour& hole : flat.holes) flatten(hole);
  return flat;
}

}  // namespace

Vec3 doubled_area(const Contour& contour) {
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < contour.size(); ++i) {
    sum += cross(contour[i] - contour[0], contour[i + 1] - contour[0]);
  }
  return sum;
}

Region without_seams(const Contour& contour) {
  if (contour.size() > kMostCorners) {
    throw InputError(
        fmt::format("a face has at most {} corners, not {}; cut it", kMostCorners, contour.size()));
  }
  const Vec3 normal = doubled_area(contour);
  Sides sides(contour);
  Region region;
  while (!sides.leading_from.empty()) {
    Contour loop = sides.take_loop();
    if (!has_area(loop)) continue;
    if (dot(doubled_area(loop), normal) <= 0) {
      region.holes.push_back(std::move(loop));
    } else if (region.outline.empty()) {
      region.outline = std::move(loop);
    } else {
      throw InputError("the face falls into pieces; write each as a face of its own");
    }
  }
  return region;
}

bool is_flat(const Region& region) {
  double farthest;
  flattened(region, farthest);
  return farthest <= 0.5 * kOffPlane * size_of(region.outline);
}

std::shared_ptr<const Shape> face_shape(const Region& region) {
  const Contour& p = region.outline;
  if (!has_area(p)) return nullptr;
  if (p.size() == 4 && region.holes.empty() &&
      length(p[0] + p[2] - p[1] - p[3]) < 1e-12 * size_of(p)) {
    return std::make_shared<Parallelogram>(p[0], p[1] - p[0], p[3] - p[0]);
  }
  if (is_flat(region)) return std::make_shared<Polygon>(p, region.holes);
  double farthest;
  const Region flat = flattened(region, farthest);
  auto triangles = Polygon(flat.outline, flat.holes)
                       .triangulate(std::numeric_limits<double>::infinity())
                       ->triangles;
  Contour corners = p;
  for (const Contour& hole : region.holes) corners.insert(corners.end(), hole.begin(), hole.end());
  return std::make_shared<TriangleMesh>(std::move(corners), std::move(triangles));
}

}  // namespace isolux
