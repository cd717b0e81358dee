#include "isolux/geometry/bezier.h"

#include <fmt/format.h>

#include "isolux/core/error.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {
namespace {

constexpr double kHair = 1e-14;           ///< lines that near to a patch meet it, of its size
constexpr std::size_t kMostPieces = 256;  ///< undecided at a time; more where a line runs inside
constexpr int kMostHalvings = 100;
constexpr double kLeastSine = 1e-12;  ///< of the angle between line and piece

struct Place {
  double u, v;
};

/// A piece of a patch, and how far it is off a line in two directions.
struct Piece {
  Bicubic a, b;
  Place corner;
  double width_u, width_v;

  Place at(double x, double y) const { return {corner.u + x * width_u, corner.v + y * width_v}; }
};

double middle(const Interval& range) { return 0.5 * (range.lo + range.hi); }
double largest(const Interval& range) { return std::max(std::abs(range.lo), std::abs(range.hi)); }
bool may_vanish(const Bicubic& f, double slack) {
  const Interval range = f.range();
  return range.lo <= slack && range.hi >= -slack;
}

bool may_vanish(const Piece& piece) {
  return may_vanish(piece.a, kHair) && may_vanish(piece.b, kHair);
}

/// Both polynomials combined such that their slopes are about 1, 0 and 0, 1.
struct Straightened {
  Bicubic x, y;
  double slack_x, slack_y;  ///< what kHair has become

  bool may_vanish() const {
    return isolux::may_vanish(x, slack_x) && isolux::may_vanish(y, slack_y);
  }
  /// Whether the slopes are so near to 1, 0 and 0, 1 that Newton's method, kept inside, contracts.
  bool is_plain() const {
    const auto deviation = [](const Bicubic& f, int along, int across) {
      return largest(f.slopes(along) - Interval(1)) + largest(f.slopes(across));
    };
    return deviation(x, 0, 1) <= 0.3 && deviation(y, 1, 0) <= 0.3;
  }
};

/// Nothing where the line runs along the piece, as far as can be told; `along` it is where the
/// patch is.
std::optional<Straightened> straightened(const Piece& piece, const Bicubic& along) {
  const Place center = piece.at(0.5, 0.5);
  const auto depth = along.at(center.u, center.v);
  const Vec3 u{middle(piece.a.slopes(0)), middle(piece.b.slopes(0)), depth.along_u * piece.width_u};
  const Vec3 v{middle(piece.a.slopes(1)), middle(piece.b.slopes(1)), depth.along_v * piece.width_v};
  const double determinant = u.x * v.y - u.y * v.x, inverse = 1 / determinant;
  if (!(std::abs(determinant) > kLeastSine * length(u) * length(v))) return std::nullopt;
  return Straightened{combined(v.y * inverse, piece.a, -v.x * inverse, piece.b),
                      combined(-u.y * inverse, piece.a, u.x * inverse, piece.b),
                      (std::abs(v.y) + std::abs(v.x)) * std::abs(inverse) * kHair,
                      (std::abs(u.y) + std::abs(u.x)) * std::abs(inverse) * kHair};
}

/// The zero in [0, 1]², of polynomials that have one at most there.
std::optional<Place> only_zero(const Straightened& f) {
  Place p{0.5, 0.5};
  for (int i = 0; i < 60; ++i) {
    const auto [x, x_u, x_v] = f.x.at(p.u, p.v);
    const auto [y, y_u, y_v] = f.y.at(p.u, p.v);
    const double determinant = x_u * y_v - x_v * y_u;
    const Place next{std::clamp(p.u - (x * y_v - y * x_v) / determinant, 0.0, 1.0),
                     std::clamp(p.v - (y * x_u - x * y_u) / determinant, 0.0, 1.0)};
    const double step = std::max(std::abs(next.u - p.u), std::abs(next.v - p.v));
    p = next;
    if (step < 1e-15) break;
  }
  const bool meets = std::abs(f.x.at(p.u, p.v).value) <= 1e-15 + 2 * f.slack_x &&
                     std::abs(f.y.at(p.u, p.v).value) <= 1e-15 + 2 * f.slack_y;
  return meets ? std::optional(p) : std::nullopt;
}

void add_place(std::vector<Place>& places, const Place& place) {
  constexpr double kSamePlace = 1e-9;
  for (const Place& other : places) {
    if (std::abs(other.u - place.u) + std::abs(other.v - place.v) < kSamePlace) return;
  }
  places.push_back(place);
}

/// Whether a piece that is a point as seen along the line is one: an edge that is shrunk to it.
bool is_point(const Piece& piece, const Bicubic& along) {
  constexpr double kFar = 1e-9;
  const auto depth = [&](double x, double y) {
    const Place place = piece.at(x, y);
    return along.at(place.u, place.v).value;
  };
  const double d = depth(0.5, 0.5);
  return std::max({std::abs(depth(0, 0) - d), std::abs(depth(1, 0) - d), std::abs(depth(0, 1) - d),
                   std::abs(depth(1, 1) - d)}) < kFar;
}

/// Adds the places where a and b, the distances off the line, are zero; `along` it is where they
/// are.
void add_zeros(const Bicubic& a, const Bicubic& b, const Bicubic& along,
               std::vector<Place>& places) {
  thread_local std::vector<Piece> pieces, halves;
  pieces.assign(1, {a, b, {0, 0}, 1, 1});
  if (!may_vanish(pieces.front())) return;
  for (int i = 0; i < kMostHalvings && pieces.size() <= kMostPieces; ++i) {
    halves.clear();
    for (const Piece& piece : pieces) {
      if (largest(piece.a.range()) < kHair && largest(piece.b.range()) < kHair) {
        if (is_point(piece, along)) add_place(places, piece.at(0.5, 0.5));
        continue;
      }
      if (const auto straight = straightened(piece, along)) {
        if (!straight->may_vanish()) continue;
        if (straight->is_plain()) {
          if (const auto zero = only_zero(*straight)) {
            add_place(places, piece.at(zero->u, zero->v));
          }
          continue;
        }
      }
      const auto length = [&](int axis) {
        return largest(piece.a.slopes(axis)) + largest(piece.b.slopes(axis));
      };
      const int axis = length(0) >= length(1) ? 0 : 1;
      const auto of_a = piece.a.halves(axis), of_b = piece.b.halves(axis);
      Piece half = piece;
      (axis == 0 ? half.width_u : half.width_v) *= 0.5;
      for (std::size_t k = 0; k < 2; ++k) {
        half.a = of_a[k], half.b = of_b[k];
        if (may_vanish(half)) halves.push_back(half);
        (axis == 0 ? half.corner.u : half.corner.v) += axis == 0 ? half.width_u : half.width_v;
      }
    }
    pieces.swap(halves);
  }
}

struct PointAndSlopes {
  Vec3 point, along_u, along_v;
};

PointAndSlopes surface_at(const std::array<Bicubic, 3>& patch, double u, double v) {
  PointAndSlopes result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [value, along_u, along_v] = patch[axis].at(u, v);
    result.point[axis] = value, result.along_u[axis] = along_u, result.along_v[axis] = along_v;
  }
  return result;
}

/// The unit normal there; of a point that an edge has shrunk to, that beside it.
Vec3 normal_at(const std::array<Bicubic, 3>& patch, const Place& place, const Vec3& otherwise) {
  for (const double inward : {0.0, 1e-6, 1e-3}) {
    const auto [point, along_u, along_v] =
        surface_at(patch, place.u + (0.5 - place.u) * inward, place.v + (0.5 - place.v) * inward);
    const Vec3 normal = cross(along_u, along_v);
    const double size = length(normal);
    if (size > 1e-10 * length(along_u) * length(along_v) && size > 1e-20) return normal / size;
  }
  return otherwise;
}

}  // namespace

Bezier::Bezier(std::vector<Points> patches) : given_(std::move(patches)) {
  if (given_.empty()) throw InputError("patches: must be one at least");
  for (const Points& points : given_) {
    if (points.size() != 16) {
      throw InputError(fmt::format("patches: each has 16 points, not {}", points.size()));
    }
    for (const Vec3& p : points) {
      require_point(p, "patches");
      bounds_.include(p);
    }
  }
  center_ = bounds_.center();
  unit_ = 0.5 * bounds_.diagonal();
  require_length(unit_, "patches");
  for (const Points& points : given_) {
    Patch& patch = patches_.emplace_back();
    for (std::size_t i = 0; i < 16; ++i) {
      const Vec3 p = (points[i] - center_) / unit_;
      for (int axis = 0; axis < 3; ++axis) patch[axis].c[i] = p[axis];
    }
    if (!(patch_area(patch) > 1e-12)) {
      throw InputError(fmt::format("patches: number {} has no area", patches_.size()));
    }
  }
}

ShapeDescription Bezier::describe() const {
  return {"bezier", {{"patches", ShapeDescription::Outlines(given_)}}, {}, {}};
}

Bounds Bezier::part_bounds(std::size_t part) const {
  Bounds box;
  for (const Vec3& p : given_[part]) box.include(p);
  return box;
}

void Bezier::intersect_part(std::size_t part, const Ray& ray, Hits& hits) const {
  const double speed = length(ray.direction);
  const Vec3 d = ray.direction / speed;
  const double shift = dot(center_ - ray.origin, d);
  const Vec3 o = (ray.origin + d * shift - center_) / unit_;
  if (!(length_squared(o) <= 1)) return;  // the patches lie in the unit ball
  const Patch& patch = patches_[part];
  const Frame frame(d);
  const auto projected = [&](const Vec3& axis) {
    Bicubic f;
    for (std::size_t i = 0; i < 16; ++i) {
      f.c[i] = dot(Vec3{patch[0].c[i], patch[1].c[i], patch[2].c[i]} - o, axis);
    }
    return f;
  };
  thread_local std::vector<Place> places;
  places.clear();
  add_zeros(projected(frame.to_world({1, 0, 0})), projected(frame.to_world({0, 1, 0})),
            projected(d), places);
  const auto first = static_cast<std::ptrdiff_t>(hits.size());
  for (const Place& place : places) {
    const Vec3 p = surface_at(patch, place.u, place.v).point;
    hits.push_back({(shift + dot(p - o, d) * unit_) / speed, center_ + p * unit_,
                    normal_at(patch, place, Vec3{} - d), 0});
  }
  std::sort(hits.begin() + first, hits.end(), [](const Hit& x, const Hit& y) { return x.t < y.t; });
}

void Bezier::intersect(const Ray& ray, Hits& hits) const {
  const auto first = static_cast<std::ptrdiff_t>(hits.size());
  for (std::size_t part = 0; part < given_.size(); ++part) intersect_part(part, ray, hits);
  std::stable_sort(hits.begin() + first, hits.end(),
                   [](const Hit& x, const Hit& y) { return x.t < y.t; });
}

bool Bezier::occludes(const Ray& ray, double t_min, double t_max) const {
  for (std::size_t part = 0; part < given_.size(); ++part) {
    if (part_occludes(part, ray, t_min, t_max)) return true;
  }
  return false;
}

bool Bezier::part_occludes(std::size_t part, const Ray& ray, double t_min, double t_max) const {
  // The patch lies between its control points, also along the ray.
  Interval reach = all_reals();
  std::swap(reach.lo, reach.hi);
  for (const Vec3& p : given_[part]) {
    reach = hull(reach, Interval(dot(p - ray.origin, ray.direction)));
  }
  const double square = length_squared(ray.direction), slack = 1e-9 * (reach.hi - reach.lo);
  if (reach.hi + slack < t_min * square || reach.lo - slack > t_max * square) return false;
  thread_local Hits hits;
  hits.clear();
  intersect_part(part, ray, hits);
  return std::any_of(hits.begin(), hits.end(),
                     [&](const Hit& hit) { return hit.t > t_min && hit.t < t_max; });
}

/// Five points of Gauss in each direction, on 8 × 8 cells.
double Bezier::patch_area(const Patch& patch) const {
  constexpr std::size_t kCells = 8;
  // Abramowitz and Stegun, table 25.4.
  constexpr std::array<double, 5> kAt = {-0.906179845938664, -0.538469310105683, 0,
                                         0.538469310105683, 0.906179845938664};
  constexpr std::array<double, 5> kWeight = {0.236926885056189, 0.478628670499366,
                                             0.568888888888889, 0.478628670499366,
                                             0.236926885056189};
  double sum = 0;
  for (std::size_t i = 0; i < 5 * kCells; ++i) {
    const double u = (static_cast<double>(i / 5) + 0.5 * (1 + kAt[i % 5])) / kCells;
    for (std::size_t j = 0; j < 5 * kCells; ++j) {
      const double v = (static_cast<double>(j / 5) + 0.5 * (1 + kAt[j % 5])) / kCells;
      const auto [point, along_u, along_v] = surface_at(patch, u, v);
      sum += kWeight[i % 5] * kWeight[j % 5] * length(cross(along_u, along_v));
    }
  }
  return sum / (4 * kCells * kCells);
}

std::optional<double> Bezier::area() const {
  double sum = 0;
  for (const Patch& patch : patches_) sum += patch_area(patch);
  return sum * unit_ * unit_;
}

/// The same cells for all patches, so that those that share an edge share its points; scaled about
/// the middle of all.
std::optional<TriangleSoup> Bezier::triangulate(double max_edge) const {
  constexpr double kLeastCells = 8;
  double longest = 0;  // of the control polygons, no shorter than their curves
  for (const Points& p : given_) {
    for (std::size_t line = 0; line < 4; ++line) {
      double row = 0, column = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        row += distance(p[4 * line + i], p[4 * line + i + 1]);
        column += distance(p[4 * i + line], p[4 * i + 4 + line]);
      }
      longest = std::max({longest, row, column});
    }
  }
  const double cells = std::max(kLeastCells, piece_count(longest, max_edge));
  require_few_triangles(2 * cells * cells * static_cast<double>(patches_.size()));
  TriangleSoup all;
  for (const Patch& patch : patches_) {
    append(all, grid(cells, cells, false, [&](double u, double v) {
             return center_ + surface_at(patch, u, v).point * unit_;
           }));
  }
  scale_to_area(all, center_, *area());
  return all;
}

}  // namespace isolux
