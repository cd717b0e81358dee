#include "isolux/radiosity/light_lattice.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numbers>

#include "isolux/geometry/shape_description.h"

namespace isolux {
namespace {

using Index = std::uint32_t;

/// Lattice cells across a flat piece.
constexpr int kLines = 8;
/// The points of the lattice that are looked at first: a knight's moves apart, so that each line of
/// the lattice has one, and a long occluder as wide as a cell can't stay between them.
constexpr bool looked_at_first(int i, int j) { return (i + 2 * j) % 5 == 0; }

/// Builds a lattice, sharing lines between triangles.
class LatticeBuilder {
 public:
  LatticeBuilder(LightLattice& light, double lift) : light_(light), lift_(lift) {}

  Index point(const Vec3& position, const Vec3& normal, bool early) {
    light_.points.push_back(position + normal * lift_);
    light_.bounds.include(light_.points.back());
    const auto index = static_cast<Index>(light_.points.size() - 1);
    (early ? light_.first_look : light_.second_look).push_back(index);
    return index;
  }

  void triangle(const std::array<Index, 3>& points) {
    const Vec3 a = light_.points[points[0]];
    const Vec3 n = cross(light_.points[points[1]] - a, light_.points[points[2]] - a);
    LatticeTriangle triangle{points, {}, normalized(n), length(n) / 2};
    for (std::size_t k = 0; k < 3; ++k) triangle.lines[k] = line(points[k], points[(k + 1) % 3]);
    light_.triangles.push_back(triangle);
  }

  /// A triangle or parallelogram corner + a u + b v as a piece with a lattice of its own.
  void flat_piece(const Vec3& corner, const Vec3& u, const Vec3& v, bool is_triangle) {
    const Vec3 normal = normalized(cross(u, v));
    Piece piece{{corner, corner + u, corner + u + v, corner + v}, 4, normal, {}, {}};
    if (is_triangle) piece.corners[2] = corner + v, piece.corner_count = 3;
    piece.first = static_cast<Index>(light_.triangles.size());
    std::array<std::array<Index, kLines + 1>, kLines + 1> at{};
    const auto width = [&](int j) { return is_triangle ? kLines - j : kLines; };
    for (int j = 0; j <= kLines; ++j) {
      for (int i = 0; i <= width(j); ++i) {
        at[j][i] = point(corner + u * (double(i) / kLines) + v * (double(j) / kLines), normal,
                         looked_at_first(i, j));
      }
    }
    for (int j = 0; j < kLines; ++j) {
      for (int i = 0; i < width(j); ++i) {
        triangle({at[j][i], at[j][i + 1], at[j + 1][i]});
        if (i + 1 > width(j + 1)) continue;
        triangle({at[j][i + 1], at[j + 1][i + 1], at[j + 1][i]});
      }
    }
    piece.end = static_cast<Index>(light_.triangles.size());
    light_.pieces.push_back(piece);
  }

  /// The unit disk: the square lattice mapped concentrically (Shirley & Chiu 1997), each ring
  /// widened a little so that its chords enclose the area of its circle.
  void disk() {
    constexpr int kRings = kLines / 2;
    std::array<std::array<Index, kLines + 1>, kLines + 1> at{};
    for (int j = 0; j <= kLines; ++j) {
      for (int i = 0; i <= kLines; ++i) {
        // What reaches in over the rim is between no two of every other point there.
        const bool on_rim = i % kLines == 0 || j % kLines == 0;
        const bool early = looked_at_first(i, j) || (on_rim && (i + j) % 2 == 0);
        at[j][i] = point(on_disk(i - kRings, j - kRings), {}, early);
      }
    }
    for (int j = 0; j < kLines; ++j) {
      for (int i = 0; i < kLines; ++i) {
        const std::array<Index, 4> cell{at[j][i], at[j][i + 1], at[j + 1][i + 1], at[j + 1][i]};
        // Cut towards the middle.
        const std::size_t k = (i < kRings) == (j < kRings) ? 0 : 1;
        triangle({cell[k], cell[k + 1], cell[k + 2]});
        triangle({cell[k], cell[k + 2], cell[(k + 3) % 4]});
      }
    }
  }

  /// A curved surface: its triangles are pieces and lattice at once.
  void curved(const TriangleSoup& soup) {
    light_.flatness = 5e-4;
    std::vector<Vec3> normals(soup.points.size());
    for (const auto& [a, b, c] : soup.triangles) {
      const Vec3 n = cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]);
      for (const Index corner : {a, b, c}) normals[corner] += n;
    }
    for (std::size_t i = 0; i < soup.points.size(); ++i) {
      normals[i] = normalized(normals[i]);
      point(soup.points[i], normals[i], true);
    }
    for (const auto& corners : soup.triangles) {
      const auto [a, b, c] = corners;
      const auto first = static_cast<Index>(light_.triangles.size());
      triangle(corners);
      light_.pieces.push_back({{soup.points[a], soup.points[b], soup.points[c], {}},
                               3,
                               light_.triangles.back().normal,
                               first,
                               first + 1});
    }
    for (LatticeLine& line : light_.lines) {
      const Vec3 turned = normals[line.to] - normals[line.from];
      const Vec3 chord = soup.points[line.to] - soup.points[line.from];
      // To second order, the surface is a parabola over its chord; a tenth more for the rest.
      const double rise = 1.1 * std::max(0.0, dot(turned, chord)) / 8;
      line.rise = normalized(normals[line.from] + normals[line.to]) * rise;
    }
    for (Piece& piece : light_.pieces) {
      for (const Index l : light_.triangles[piece.first].lines) {
        const LatticeLine& line = light_.lines[l];
        const Vec3 turned = normals[line.to] - normals[line.from];
        const Vec3 chord = soup.points[line.to] - soup.points[line.from];
        piece.off = std::max(piece.off, std::abs(dot(turned, chord)) / 4);
      }
    }
  }

 private:
  /// Where the point (x, y) of the square lattice, counted from its middle, lies on the disk.
  static Vec3 on_disk(int x, int y) {
    using std::numbers::pi;
    const int ring = std::max(std::abs(x), std::abs(y));
    if (ring == 0) return {};
    const double quarter = pi / 4;
    const double angle = std::abs(x) == ring ? quarter * (double(y) / x) + (x < 0 ? pi : 0)
                                             : quarter * (2 - double(x) / y) + (y < 0 ? pi : 0);
    const double side = quarter / ring;  // of the polygon in the circle, rad
    const double radius = ring / (0.5 * kLines) * std::sqrt(side / std::sin(side));
    return {radius * std::cos(angle), radius * std::sin(angle), 0};
  }

  Index line(Index a, Index b) {
    const auto [found, born] =
        known_.try_emplace(std::minmax(a, b), static_cast<Index>(light_.lines.size()));
    if (born) light_.lines.push_back({a, b, {}});
    return found->second;
  }

  LightLattice& light_;
  double lift_;
  std::map<std::pair<Index, Index>, Index> known_;
};

/// The object as a ball, where it is one that shines outwards.
std::optional<Ball> ball_of(const Object& object, double lift) {
  const ShapeDescription shape = object.shape->describe();
  if (shape.kind != "sphere") return std::nullopt;
  Ball ball{*shape.find<Vec3>("center"), *shape.find<double>("radius"), lift};
  if (shape.transform) {
    const std::optional<double> factor = shape.transform->similarity();
    if (!factor) return std::nullopt;
    ball.center = shape.transform->point(ball.center);
    ball.radius *= *factor;
  }
  return ball;
}

}  // namespace

std::shared_ptr<const LightLattice> lattice_of(const Scene& scene, std::uint32_t index,
                                               double lift) {
  const Object& object = scene.objects[index];
  constexpr std::size_t kMostFlat = 16;  // triangles; of more, each is small enough by itself
  auto light = std::make_shared<LightLattice>();
  light->object = index;
  light->exitance = object.exitance;
  light->ball = ball_of(object, lift);
  LatticeBuilder builder(*light, lift);
  if (light->ball) {
    builder.disk();
    return light;
  }
  const double size = object.shape->bounds().diagonal();
  const TriangleSoup soup = *object.shape->triangulate(size);
  const std::vector<Vec3>& p = soup.points;
  const double tolerance = 1e-9 * size;
  if (soup.triangles.size() > kMostFlat) {
    builder.curved(*object.shape->triangulate(size / kLines));
    return light;
  }
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    const auto [a, b, c] = soup.triangles[i];
    // Two triangles in a row that make a parallelogram: (a, b, c) and (a, c, d).
    bool pair = false;
    if (i + 1 < soup.triangles.size()) {
      const auto next = soup.triangles[i + 1];
      for (std::size_t k = 0; k < 3 && !pair; ++k) {
        const std::array<Index, 3> t{soup.triangles[i][k], soup.triangles[i][(k + 1) % 3],
                                     soup.triangles[i][(k + 2) % 3]};
        for (std::size_t m = 0; m < 3 && !pair; ++m) {
          const Vec3 fourth = p[t[0]] + p[t[2]] - p[t[1]];
          pair = distance(p[next[m]], p[t[0]]) <= tolerance &&
                 distance(p[next[(m + 1) % 3]], p[t[2]]) <= tolerance &&
                 distance(p[next[(m + 2) % 3]], fourth) <= tolerance;
          if (pair) builder.flat_piece(p[t[1]], p[t[2]] - p[t[1]], p[t[0]] - p[t[1]], false);
        }
      }
    }
    if (pair) {
      ++i;
    } else {
      builder.flat_piece(p[a], p[b] - p[a], p[c] - p[a], true);
    }
  }
  return light;
}

}  // namespace isolux
