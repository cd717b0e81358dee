#include "isolux/geometry/box.h"

#include <fmt/format.h>

#include "isolux/core/error.h"
#include "isolux/core/vectorize.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Box::occludes() for many lines at once.
ISOLUX_VECTORIZE
void occlude_by_box(const SegmentBlock& segments, const Vec3& lower, const Vec3& upper,
                    double t_max, SegmentBlock::Mask& blocked) {
  for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) {
    double first = -kInfinity, last = kInfinity;
    bool crosses = true, starts_inside = true, ends_inside = true;
    // Along an axis that the line does not run, both ends are infinite: apart inside, else alike.
    const auto clip = [&](double o, double d, double low, double high) {
      const double at_low = (low - o) / d, at_high = (high - o) / d, end = o + d * t_max;
      const double enter = std::min(at_low, at_high), leave = std::max(at_low, at_high);
      crosses &= enter < leave;
      first = std::max(first, enter);
      last = std::min(last, leave);
      starts_inside &= (o > low) & (o < high);
      ends_inside &= (end > low) & (end < high);
    };
    clip(segments.from_x[i], segments.way_x[i], lower.x, upper.x);
    clip(segments.from_y[i], segments.way_y[i], lower.y, upper.y);
    clip(segments.from_z[i], segments.way_z[i], lower.z, upper.z);
    crosses &= (first < last) & (last - first < kInfinity);
    const bool met = ((first > 0) & (first < t_max)) | ((last > 0) & (last < t_max));
    blocked[i] |= crosses & met & !(starts_inside & ends_inside);
  }
}

}  // namespace

Box::Box(const Vec3& lower, const Vec3& upper) : lower_(lower), upper_(upper) {
  require_point(lower, "lower");
  require_point(upper, "upper");
  for (int axis = 0; axis < 3; ++axis) {
    if (upper[axis] - lower[axis] >= kShortestLength) continue;
    throw InputError(fmt::format(
        "upper: {} must be greater than that of lower in every coordinate, but {} <= {}",
        "xyz"[axis], upper[axis], lower[axis]));
  }
}

std::optional<Box::Piece> Box::inside(const Ray& ray) const {
  Piece piece{-kInfinity, kInfinity, 0, 0};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const int i = static_cast<int>(axis);
    const double o = ray.origin[i], d = ray.direction[i];
    if (d == 0) {
      if (!(o > lower_[i] && o < upper_[i])) return std::nullopt;
      continue;
    }
    const std::uint32_t up = d > 0 ? 1 : 0;
    const double enter = ((up ? lower_[i] : upper_[i]) - o) / d;
    const double leave = ((up ? upper_[i] : lower_[i]) - o) / d;
    if (!(enter < leave)) return std::nullopt;  // not numbers
    if (enter > piece.enter) piece.enter = enter, piece.enter_face = 2 * axis + 1 - up;
    if (leave < piece.leave) piece.leave = leave, piece.leave_face = 2 * axis + up;
  }
  const bool crosses = piece.enter < piece.leave && std::isfinite(piece.leave - piece.enter);
  return crosses ? std::optional(piece) : std::nullopt;
}

Hit Box::hit(const Ray& ray, double t, std::uint32_t face) const {
  const int axis = static_cast<int>(face / 2);
  const bool up = face % 2;
  Vec3 point = max(lower_, min(upper_, ray.at(t)));
  point[axis] = up ? upper_[axis] : lower_[axis];
  Vec3 normal;
  normal[axis] = up ? 1 : -1;
  return {t, point, normal, face};
}

void Box::intersect(const Ray& ray, Hits& hits) const {
  const auto piece = inside(ray);
  if (!piece) return;
  hits.push_back(hit(ray, piece->enter, piece->enter_face));
  hits.push_back(hit(ray, piece->leave, piece->leave_face));
}

bool Box::occludes(const Ray& ray, double t_min, double t_max) const {
  // A box is convex: between two points inside it nothing of its surface is met.
  if (contains(ray.at(t_min)) && contains(ray.at(t_max))) return false;
  const auto p = inside(ray);
  return p && ((p->enter > t_min && p->enter < t_max) || (p->leave > t_min && p->leave < t_max));
}

void Box::occlude(const SegmentBlock& segments, double t_max, SegmentBlock::Mask& blocked) const {
  occlude_by_box(segments, lower_, upper_, t_max, blocked);
}

bool Box::avoids(const Bounds& box) const {
  return !bounds().overlaps(box) || bounds().encloses(box);
}

bool Box::contains(const Vec3& p) const {
  return p.x > lower_.x && p.y > lower_.y && p.z > lower_.z && p.x < upper_.x && p.y < upper_.y &&
         p.z < upper_.z;
}

std::optional<double> Box::area() const {
  const Vec3 s = upper_ - lower_;
  return 2 * (s.x * s.y + s.y * s.z + s.z * s.x);
}

std::optional<TriangleSoup> Box::triangulate(double max_edge) const {
  TriangleSoup soup;
  const Vec3 size = upper_ - lower_;
  for (int axis = 0; axis < 3; ++axis) {
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    for (const bool up : {false, true}) {
      TriangleSoup face = grid(piece_count(size[first], max_edge),
                               piece_count(size[second], max_edge), false, [&](double a, double b) {
                                 Vec3 p = up ? upper_ : lower_;
                                 p[first] = lower_[first] + a * size[first];
                                 p[second] = lower_[second] + b * size[second];
                                 return p;
                               });
      if (!up) flip(face);
      append(soup, face);
    }
  }
  return soup;
}

ShapeDescription Box::describe() const {
  return {"box", {{"lower", lower_}, {"upper", upper_}}, {}, {}};
}

}  // namespace isolux
