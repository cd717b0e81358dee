#include "isolux/geometry/height_field.h"

#include <fmt/format.h>

#include <algorithm>

#include "isolux/core/error.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {

// Along a line its height over the surface, g(s) = z(s) − height(x(s), y(s)), is continuous, and
// linear between the places where the line, seen from above, crosses a side of a triangle: where x,
// y or x + y is a whole number. g is found once at each of these places; where its sign changes
// from one to the next, there is a hit. So none is lost or doubled on an edge.

namespace {

/// The places s, in ascending order, at which a coordinate that starts as `at_zero` and grows by
/// `speed` is a whole number.
class Ticks {
 public:
  Ticks(double at_zero, double speed, double from) : at_zero_(at_zero), speed_(speed) {
    const double value = at_zero + from * speed;
    tick_ = speed > 0 ? std::floor(value) + 1 : std::ceil(value) - 1;
  }
  double next() const {
    return speed_ == 0 ? std::numeric_limits<double>::infinity() : (tick_ - at_zero_) / speed_;
  }
  void pass() { tick_ += speed_ > 0 ? 1 : -1; }

 private:
  double at_zero_, speed_, tick_;
};

}  // namespace

HeightField::HeightField(const Vec3& corner, const Vec3& u, const Vec3& v,
                         std::vector<std::vector<double>> heights)
    : corner_(corner), u_(u), v_(v), heights_(std::move(heights)) {
  require_point(corner, "corner");
  require_direction(u, "u");
  require_direction(v, "v");
  constexpr std::size_t kMost = 4096;
  const auto fits = [](std::size_t count) { return count >= 2 && count <= kMost; };
  if (!fits(heights_.size()) || !fits(heights_.front().size())) {
    throw InputError(fmt::format("heights: needs 2 to {} rows of 2 to {} numbers", kMost, kMost));
  }
  rows_ = heights_.size() - 1, columns_ = heights_.front().size() - 1;
  const Vec3 up = cross(u, v);
  if (!(length(up) > 1e-12 * length(u) * length(v))) {
    throw InputError("u and v: must not be parallel");
  }
  const Vec3 x = u / static_cast<double>(columns_), y = v / static_cast<double>(rows_);
  const Vec3 z = normalized(up);
  to_world_ = {{Vec3{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}, corner};
  const auto inverse = to_world_.inverse();
  if (!inverse) throw InputError("u and v: too small or too flat for so many heights");
  to_local_ = *inverse;
  lowest_ = highest_ = heights_[0][0];
  for (std::size_t j = 0; j <= rows_; ++j) {
    if (heights_[j].size() != columns_ + 1) {
      throw InputError(fmt::format("heights: row {} has {} numbers, and the first one {}", j,
                                   heights_[j].size(), columns_ + 1));
    }
    for (std::size_t i = 0; i <= columns_; ++i) {
      const double height = heights_[j][i];
      require_point({0, 0, height}, "heights");
      lowest_ = std::min(lowest_, height), highest_ = std::max(highest_, height);
      bounds_.include(to_world_.point({static_cast<double>(i), static_cast<double>(j), height}));
    }
  }
}

/// The triangle over (x, y), or over the nearest place of the grid.
HeightField::Facet HeightField::facet(double x, double y) const {
  const double i = std::clamp(std::floor(x), 0.0, static_cast<double>(columns_ - 1));
  const double j = std::clamp(std::floor(y), 0.0, static_cast<double>(rows_ - 1));
  const auto& row = heights_[static_cast<std::size_t>(j)];
  const auto& next = heights_[static_cast<std::size_t>(j) + 1];
  const auto k = static_cast<std::size_t>(i);
  if (x - i + (y - j) <= 1) return {i, j, row[k], row[k + 1] - row[k], next[k] - row[k]};
  return {i + 1, j + 1, next[k + 1], next[k + 1] - next[k], next[k + 1] - row[k + 1]};
}

void HeightField::intersect(const Ray& ray, Hits& hits) const {
  const double shift =
      dot(bounds_.center() - ray.origin, ray.direction) / length_squared(ray.direction);
  const Vec3 o = to_local_.point(ray.at(shift)), d = to_local_.vector(ray.direction);
  if (!is_finite(o) || !is_finite(d) || d == Vec3{}) return;
  const double room = 1e-3 * (highest_ - lowest_) + 1e-6 * bounds_.diagonal();
  const Vec3 lower{0, 0, lowest_ - room};
  const Vec3 upper{static_cast<double>(columns_), static_cast<double>(rows_), highest_ + room};
  double from = -std::numeric_limits<double>::infinity(), to = -from;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) {
      if (!(o[axis] >= lower[axis] && o[axis] <= upper[axis])) return;
      continue;
    }
    const double a = (lower[axis] - o[axis]) / d[axis], b = (upper[axis] - o[axis]) / d[axis];
    from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
  }
  if (!(from < to) || !std::isfinite(to - from)) return;

  const auto height_over = [&](double s) {
    const double x = o.x + s * d.x, y = o.y + s * d.y;
    return o.z + s * d.z - facet(x, y).height(x, y);
  };
  Ticks x_ticks(o.x, d.x, from), y_ticks(o.y, d.y, from), diagonals(o.x + o.y, d.x + d.y, from);
  double before = from, g_before = height_over(from);
  while (before < to) {
    double here = to;
    for (const Ticks* ticks : {&x_ticks, &y_ticks, &diagonals})
      here = std::min(here, ticks->next());
    for (Ticks* ticks : {&x_ticks, &y_ticks, &diagonals}) {
      if (ticks->next() <= here) ticks->pass();
    }
    if (!(here > before)) continue;
    const double g = height_over(here);
    if ((g < 0) != (g_before < 0)) {
      const double s = before + (here - before) * (g_before / (g_before - g));
      const double middle = 0.5 * (before + here);
      const Facet at = facet(o.x + middle * d.x, o.y + middle * d.y);
      const double x = o.x + s * d.x, y = o.y + s * d.y;
      hits.push_back({shift + s, to_world_.point({x, y, at.height(x, y)}),
                      normalized(to_local_.transposed({-at.x_slope, -at.y_slope, 1})), 0});
    }
    before = here, g_before = g;
  }
}

TriangleSoup HeightField::soup() const {
  if (2.0 * static_cast<double>(rows_ * columns_) > kMostTriangles) {
    throw InputError("a height field of more than 1e6 triangles can't be cut into them");
  }
  TriangleSoup soup;
  const auto stride = static_cast<std::uint32_t>(columns_ + 1);
  for (std::uint32_t j = 0; j <= rows_; ++j) {
    for (std::uint32_t i = 0; i < stride; ++i) {
      soup.points.push_back(to_world_.point({double(i), double(j), heights_[j][i]}));
      if (i == columns_ || j == rows_) continue;
      const std::uint32_t at = j * stride + i;
      soup.triangles.push_back({at, at + 1, at + stride});
      soup.triangles.push_back({at + 1, at + 1 + stride, at + stride});
    }
  }
  return soup;
}

std::optional<double> HeightField::area() const {
  // The area of a triangle is that of its foot, divided by the normal's height.
  const double foot = 0.5 * std::abs(to_world_.determinant());
  double sum = 0;
  for (std::size_t j = 0; j < rows_; ++j) {
    for (std::size_t i = 0; i < columns_; ++i) {
      for (const double third : {1.0 / 3, 2.0 / 3}) {
        const Facet at = facet(static_cast<double>(i) + third, static_cast<double>(j) + third);
        sum += foot * length(to_local_.transposed({-at.x_slope, -at.y_slope, 1}));
      }
    }
  }
  return sum;
}

std::optional<TriangleSoup> HeightField::triangulate(double max_edge) const {
  TriangleSoup triangles = soup();
  subdivide(triangles, max_edge);
  return triangles;
}

ShapeDescription HeightField::describe() const {
  return {
      "height_field", {{"corner", corner_}, {"u", u_}, {"v", v_}, {"heights", heights_}}, {}, {}};
}

}  // namespace isolux
