#include <fmt/format.h>

#include <cmath>

#include "isolux/formats/limits.h"
#include "isolux/formats/radiance/expression.h"
#include "isolux/formats/radiance/generators.h"
#include "isolux/geometry/triangle_mesh.h"
#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace {

constexpr double kMostEffort = 1e8;    ///< steps of all expressions of a scene
constexpr std::size_t kOverhead = 10;  ///< of an expression at a point, in steps
constexpr double kLevel = 1e-9;        ///< m: as good as no difference

/// A word that says how many there are, which may be an expression.
int count(const Statement& s, std::size_t i) {
  const double value = std::floor(Expression(s, i, {})({}) + 0.5);
  if (value >= 1 && value <= kMostObjects) return static_cast<int>(value);
  s.fail(i, fmt::format("expected a whole number from 1 to {}, not {}", kMostObjects,
                        in_quotes(s.word(i))));
}

std::vector<Expression> expressions(const Statement& s, std::size_t first, std::size_t end,
                                    const std::vector<std::string_view>& variables) {
  std::vector<Expression> list;
  for (std::size_t i = first; i < end; ++i) list.emplace_back(s, i, variables);
  return list;
}

void spend(const Statement& s, const std::vector<Expression>& functions, double points,
           double& effort) {
  for (const Expression& function : functions) {
    effort += points * static_cast<double>(kOverhead + function.effort());
  }
  if (effort > kMostEffort) {
    s.fail(0, "the expressions of this scene take too long for so many points");
  }
}

/// Options from word i on: -s, and those of `more`.
bool read_options(const Statement& s, std::size_t i, Notes& notes, std::string_view more = "") {
  bool found = false;
  for (; i < s.size(); ++i) {
    if (s.word(i) == more) {
      found = true;
    } else if (s.word(i) == "-s") {
      notes.left_out("-s", "surfaces made of pieces are not smoothed");
    } else {
      throw Unsupported{fmt::format("the option {}", in_quotes(s.word(i)))};
    }
  }
  return found;
}

/// The functions of t that the words from 3 on give, one column each, at the ends of all segments.
std::vector<std::vector<double>> curve(const Statement& s, std::size_t functions, double& effort) {
  const auto list = expressions(s, 3, 3 + functions, {"t"});
  const int segments = count(s, 3 + functions);
  spend(s, list, segments + 1.0, effort);
  std::vector<std::vector<double>> rows;
  for (int i = 0; i <= segments; ++i) {
    std::vector<double>& row = rows.emplace_back();
    for (const Expression& function : list) row.push_back(function({double(i) / segments}));
    if (row.back() < 0) s.fail(2 + functions, "the radius must not be negative");
  }
  return rows;
}

}  // namespace

std::vector<Surface> generate_revolution(const Statement& s, Surroundings& around) {
  s.expect_arguments(5, Statement::kAnyNumber, "genrev modifier name z(t) r(t) segments");
  read_options(s, 6, around.notes);
  const auto rows = curve(s, 2, around.effort);
  std::vector<Surface> surfaces;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double z0 = rows[i - 1][0], z1 = rows[i][0];
    double r0 = rows[i - 1][1], r1 = rows[i][1];
    const bool level = std::abs(z1 - z0) <= kLevel;
    if (level && std::abs(r1 - r0) <= kLevel) continue;
    if (level) {
      const Vec3 normal{0, 0, r1 < r0 ? 1.0 : -1.0};
      surfaces.push_back({placed_ring({0, 0, z1}, normal, std::min(r0, r1), std::max(r0, r1))});
      continue;
    }
    if (std::abs(r1 - r0) <= kLevel) r0 = r1;
    const double side = z1 > z0 ? 1 : -1;  // outward where z rises
    surfaces.push_back({placed_tube({0, 0, z0}, {0, 0, z1}, side * r0, side * r1)});
  }
  return surfaces;
}

std::vector<Surface> generate_worm(const Statement& s, Surroundings& around) {
  s.expect_arguments(7, Statement::kAnyNumber,
                     "genworm modifier name x(t) y(t) z(t) r(t) segments");
  read_options(s, 8, around.notes);
  const auto rows = curve(s, 4, around.effort);
  const auto point = [&](std::size_t i) { return Vec3{rows[i][0], rows[i][1], rows[i][2]}; };
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double r1 = rows[i][3];
    surfaces.push_back({placed_ball(point(i), r1)});
    if (i == 0) continue;
    const double r0 = rows[i - 1][3];
    // The cone that touches both balls; none where one swallows the other.
    const Vec3 way = point(i) - point(i - 1);
    const double slope = (r0 - r1) / length(way);
    if (!(std::abs(slope) < 1)) continue;
    const Vec3 shift = normalized(way) * slope;
    const double part = std::sqrt(1 - slope * slope);
    surfaces.push_back(
        {placed_tube(point(i - 1) + shift * r0, point(i) + shift * r1, part * r0, part * r1)});
  }
  return surfaces;
}

std::vector<Surface> generate_surface(const Statement& s, Surroundings& around) {
  s.expect_arguments(7, Statement::kAnyNumber, "gensurf modifier name x(s,t) y(s,t) z(s,t) m n");
  const bool inward = read_options(s, 8, around.notes, "-i");
  const auto functions = expressions(s, 3, 6, {"s", "t"});
  const int m = count(s, 6), n = count(s, 7);
  if (2.0 * m * n > kMostTriangles) {
    s.fail(6, fmt::format("the surface has more than {} triangles", kMostTriangles));
  }
  spend(s, functions, (m + 1.0) * (n + 1.0), around.effort);
  std::vector<Vec3> points;
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j <= n; ++j) {
      const std::vector<double> at{double(i) / m, double(j) / n};
      points.push_back({functions[0](at), functions[1](at), functions[2](at)});
    }
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (inward) std::swap(b, c);
    const Vec3 u = points[b] - points[a], v = points[c] - points[a];
    const double size = std::max({length(u), length(v), length(v - u)});
    if (length(cross(u, v)) > 1e-9 * size * size) triangles.push_back({a, b, c});
  };
  // Cells are cut alternately, so that what is even looks even.
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (n + 1) + j), b = a + 1;
      const std::uint32_t c = a + static_cast<std::uint32_t>(n) + 1, d = c + 1;
      if (j % 2 == 1) {
        add(a, c, b), add(b, c, d);
      } else {
        add(c, d, a), add(a, d, b);
      }
    }
  }
  Surface surface;
  surface.triangles = triangles.size();
  surface.shape = [=](const Affine& map) -> std::shared_ptr<const Shape> {
    if (triangles.empty()) return nullptr;
    std::vector<Vec3> placed;
    for (const Vec3& p : points) placed.push_back(map.point(p));
    auto faces = triangles;
    if (map.determinant() < 0) {
      for (auto& [a, b, c] : faces) std::swap(b, c);
    }
    return std::make_shared<TriangleMesh>(std::move(placed), std::move(faces));
  };
  return {surface};
}

}  // namespace isolux::radiance
