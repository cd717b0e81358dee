#include "isolux/inspection/surface_points.h"

#include <algorithm>

#include "isolux/core/parallel.h"
#include "isolux/core/random.h"
#include "isolux/sampling/lines.h"

namespace isolux {
namespace {

constexpr std::size_t kMostPoints = 64, kLeastPoints = 16;  // of an object
constexpr std::size_t kAllPoints = 1'000'000;               // about, of many objects
constexpr int kMostLines = 4096;

std::vector<Hit> points_on(const Shape& shape, std::uint64_t stream, std::size_t count) {
  constexpr std::uint64_t kSeed = 1;
  Random random(kSeed, stream);
  std::vector<Hit> points;
  Hits hits;
  for (int line = 0; line < kMostLines && points.size() < count; ++line) {
    const std::size_t part = random.below(shape.part_count());
    const Bounds box = shape.part_bounds(part);
    const Vec3 size = box.upper - box.lower;
    const Vec3 through = box.lower + Vec3{size.x * random.uniform(), size.y * random.uniform(),
                                          size.z * random.uniform()};
    hits.clear();
    shape.intersect_part(part, {through, random_line({}, 1, random).direction}, hits);
    if (!hits.empty()) points.push_back(hits[random.below(hits.size())]);
  }
  return points;
}

}  // namespace

std::vector<std::vector<Hit>> points_on_objects(const Scene& scene) {
  std::vector<std::vector<Hit>> points(scene.objects.size());
  const std::size_t share = kAllPoints / std::max<std::size_t>(1, points.size());
  const std::size_t count = std::clamp(share, kLeastPoints, kMostPoints);
  parallel_for(points.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      points[i] = points_on(*scene.objects[i].shape, i, count);
  });
  return points;
}

}  // namespace isolux
