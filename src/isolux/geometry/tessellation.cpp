#include "isolux/geometry/tessellation.h"

#include <fmt/format.h>

#include <numbers>
#include <unordered_map>

#include "isolux/core/error.h"

namespace isolux {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using std::numbers::pi;

/// Shirley and Chiu 1997: the square [−1, 1]² onto the unit disk, squares to circles.
Vec3 concentric(double a, double b) {
  if (a == 0 && b == 0) return {};
  const bool along_a = std::abs(a) > std::abs(b);
  const double r = along_a ? a : b;
  const double angle = along_a ? pi / 4 * (b / a) : pi / 2 - pi / 4 * (a / b);
  return {r * std::cos(angle), r * std::sin(angle), 0};
}

/// The midpoints of the edges of a soup that are too long, as new points of it.
class Midpoints {
 public:
  Midpoints(TriangleSoup& soup, double max_edge, const std::function<Vec3(const Vec3&)>& project)
      : soup_(soup), max_edge_(max_edge), project_(project) {}

  /// The midpoint of the edge a b, or nothing where it is short enough.
  std::optional<std::uint32_t> of(std::uint32_t a, std::uint32_t b) {
    const Vec3 p = soup_.points[a], q = soup_.points[b];
    if (!(distance(p, q) > max_edge_ * (1 + 1e-9))) return std::nullopt;
    const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    const auto next = static_cast<std::uint32_t>(soup_.points.size());
    const auto [found, is_new] = points_.try_emplace(key, next);
    if (is_new) soup_.points.push_back(project_ ? project_((p + q) * 0.5) : (p + q) * 0.5);
    return found->second;
  }

 private:
  TriangleSoup& soup_;
  double max_edge_;
  const std::function<Vec3(const Vec3&)>& project_;
  std::unordered_map<std::uint64_t, std::uint32_t> points_;
};

/// Adds the pieces of the quadrilateral a b c d, cut along its shorter diagonal.
void add_quad(const std::vector<Vec3>& points, std::array<std::uint32_t, 4> q,
              std::vector<Corners>& out) {
  const double ac = distance(points[q[0]], points[q[2]]);
  const double bd = distance(points[q[1]], points[q[3]]);
  const bool cut_bd = bd < ac * (1 - 1e-9);  // where equal, always the same way
  for (const Corners& t : cut_bd ? std::array{Corners{q[0], q[1], q[3]}, Corners{q[1], q[2], q[3]}}
                                 : std::array{Corners{q[0], q[1], q[2]}, Corners{q[0], q[2], q[3]}})
    out.push_back(t);
}

/// Adds the pieces of `t` (1 to 4); true where it was cut.
bool cut_triangle(TriangleSoup& soup, Corners t, Midpoints& midpoints, std::vector<Corners>& out) {
  std::array<std::optional<std::uint32_t>, 3> m;
  int cuts = 0;
  for (int i = 0; i < 3; ++i) cuts += (m[i] = midpoints.of(t[i], t[(i + 1) % 3])).has_value();
  if (cuts == 0) {
    out.push_back(t);
  } else if (cuts == 3) {
    for (int i = 0; i < 3; ++i) out.push_back({t[i], *m[i], *m[(i + 2) % 3]});
    out.push_back({*m[0], *m[1], *m[2]});
  } else {
    // Turned so that edge 0 is cut, and edge 2 is not.
    int i = 0;
    while (!m[i] || m[(i + 2) % 3]) ++i;
    const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
    const std::uint32_t ab = *m[i];
    if (const auto bc = m[(i + 1) % 3]) {
      out.push_back({ab, b, *bc});
      add_quad(soup.points, {a, ab, *bc, c}, out);
    } else {
      out.push_back({a, ab, c});
      out.push_back({ab, b, c});
    }
  }
  return cuts > 0;
}

}  // namespace

void require_few_triangles(double count) {
  if (count <= kMostTriangles * (1 + 1e-9)) return;
  throw InputError(fmt::format(
      "cutting the surface gives more than {:g} triangles; use a longer max_edge", kMostTriangles));
}

double piece_count(double length, double max_edge) {
  if (!(max_edge > 0)) {
    throw InputError(fmt::format("max_edge: must be a length greater than 0, not {}", max_edge));
  }
  return std::max(1.0, std::ceil(length / max_edge - 1e-9));
}

double circle_segments(double radius, double max_edge) {
  // The concentric map's cells are widest, 2 r / m, along the diameters of its square of m × m.
  return 4 * std::max(8.0, 2 * piece_count(radius, max_edge));
}

TriangleSoup grid(double nu, double nv, bool closed,
                  const std::function<Vec3(double, double)>& point) {
  require_few_triangles(2 * nu * nv);
  const auto columns = static_cast<std::uint32_t>(nu), rows = static_cast<std::uint32_t>(nv);
  const std::uint32_t stride = closed ? columns : columns + 1;
  TriangleSoup soup;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i < stride; ++i) soup.points.push_back(point(i / nu, j / nv));
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t next = (i + 1) % stride;
      const std::uint32_t low = j * stride, high = low + stride;
      add_quad(soup.points, {low + i, low + next, high + next, high + i}, soup.triangles);
    }
  }
  std::erase_if(soup.triangles, [&](const Corners& t) {
    constexpr double kSame = 1e-9;  // of the longest side
    const Vec3 &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
    const auto [least, most] = std::minmax({distance(a, b), distance(b, c), distance(c, a)});
    return least <= kSame * most;
  });
  return soup;
}

TriangleSoup disk_triangles(const Vec3& center, const Vec3& normal, double radius, double inner,
                            double segments, double max_edge) {
  const Frame frame(normal);
  TriangleSoup soup;
  if (inner > 0) {
    soup = grid(segments, piece_count(radius - inner, max_edge), true, [&](double u, double v) {
      const double r = radius + v * (inner - radius), angle = 2 * pi * u;
      return center + frame.u * (r * std::cos(angle)) + frame.v * (r * std::sin(angle));
    });
  } else {
    soup = grid(segments / 4, segments / 4, false, [&](double u, double v) {
      return center + frame.to_world(concentric(2 * u - 1, 2 * v - 1)) * radius;
    });
  }
  scale_to_area(soup, center, pi * (radius - inner) * (radius + inner));
  return soup;
}

void subdivide(TriangleSoup& soup, double max_edge,
               const std::function<Vec3(const Vec3&)>& project) {
  piece_count(1, max_edge);
  // No triangle with such sides is larger than the equilateral one.
  require_few_triangles(area(soup) / (std::sqrt(3.0) / 4 * max_edge * max_edge));
  for (bool cut = true; cut;) {
    cut = false;
    Midpoints midpoints(soup, max_edge, project);
    std::vector<Corners> pieces;
    for (const Corners& t : soup.triangles) {
      cut |= cut_triangle(soup, t, midpoints, pieces);
      require_few_triangles(static_cast<double>(pieces.size()));
    }
    soup.triangles = std::move(pieces);
  }
}

void append(TriangleSoup& to, const TriangleSoup& from) {
  const auto offset = static_cast<std::uint32_t>(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  for (const Corners& t : from.triangles) {
    to.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  require_few_triangles(static_cast<double>(to.triangles.size()));
}

void flip(TriangleSoup& soup) {
  for (Corners& t : soup.triangles) std::swap(t[1], t[2]);
}

double area(const TriangleSoup& soup) {
  double sum = 0;
  for (const Corners& t : soup.triangles) {
    const Vec3& a = soup.points[t[0]];
    sum += 0.5 * length(cross(soup.points[t[1]] - a, soup.points[t[2]] - a));
  }
  return sum;
}

void scale_to_area(TriangleSoup& soup, const Vec3& center, double wanted) {
  const double scale = std::sqrt(wanted / area(soup));
  for (Vec3& p : soup.points) p = center + (p - center) * scale;
}

}  // namespace isolux
