#include "isolux/geometry/bicubic_zeros.h"

#include <optional>

#include "isolux/core/vec3.h"

namespace isolux {

// On [0, 1]², T(p) = p − F(p), moved to the nearest point of the square, contracts by the deviation
// q, and a zero z of F stays where it is. So from p it is |p − z| ≤ |T(p) − p| / (1 − q) away, and
// |F(p)| ≤ (1 + q) |p − z|, all in the maximum norm: where F is larger, there is no zero.

NearIdentity::Zeros NearIdentity::search(Place& p) const {
  constexpr int kMostSteps = 16;
  constexpr double kRounding = 1e-15;
  const double q = deviation, slack = std::max(slack_x, slack_y);
  const auto in_square = [](double u, double v) {
    return Place{std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0)};
  };
  const auto difference = [](const Place& a, const Place& b) {
    return std::max(std::abs(a.u - b.u), std::abs(a.v - b.v));
  };
  for (int i = 0; i < kMostSteps; ++i) {
    const CubicBasis u(p.u), v(p.v);
    const auto [fx, x_u, x_v] = x.slopes_at(u, v);
    const auto [fy, y_u, y_v] = y.slopes_at(u, v);
    if (std::abs(fx) <= slack_x && std::abs(fy) <= slack_y) return Zeros::one;
    const Place contracted = in_square(p.u - fx, p.v - fy);
    const double off = difference(p, contracted) + slack;
    if (std::max(std::abs(fx), std::abs(fy)) - slack > (1 + q) / (1 - q) * off) return Zeros::none;
    const double inverse = 1 / (x_u * y_v - x_v * y_u);
    const Place newton{p.u - (fx * y_v - fy * x_v) * inverse,
                       p.v - (fy * x_u - fx * y_u) * inverse};
    const Place inside = in_square(newton.u, newton.v);
    if (inside.u != newton.u || inside.v != newton.v) {
      p = contracted;
      continue;
    }
    // The second derivatives along u, u and v, and v are 4 q, 6 q and 4 q at most, which bounds the
    // error of Newton's step.
    const double step = difference(p, newton);
    p = newton;
    if (10 * q * step * step <= kRounding * (1 - q)) return Zeros::one;
  }
  return Zeros::unknown;
}

double unevenness(const Bicubic& x, const Bicubic& y, int axis) {
  const Bicubic &own = axis == 0 ? x : y, &other = axis == 0 ? y : x;
  return std::max({own.largest_second(axis, axis), other.largest_second(axis, axis),
                   other.largest_second(0, 1)});
}

double Depth::at(const Place& place) const {
  const CubicBasis u(place.u), v(place.v);
  return scaled.at(u, v) / weight.at(u, v);
}

namespace {

constexpr std::size_t kMostPieces = 256;  ///< undecided at a time; more where a line runs inside
constexpr int kMostHalvings = 100;

/// A piece of a patch, and how far it is off a line in two directions.
struct Piece {
  Bicubic a, b;
  Place corner;
  double width_u, width_v;

  Place at(double x, double y) const { return {corner.u + x * width_u, corner.v + y * width_v}; }
  bool may_vanish() const { return a.may_vanish(kHair) && b.may_vanish(kHair); }
};

/// p a + q b.
Bicubic combined(double p, const Bicubic& a, double q, const Bicubic& b) {
  Bicubic sum;
  for (std::size_t i = 0; i < 16; ++i) sum.c[i] = p * a.c[i] + q * b.c[i];
  return sum;
}

/// Both polynomials combined such that their slopes are about 1, 0 and 0, 1. Nothing where the line
/// runs along the piece, as far as can be told.
std::optional<NearIdentity> straightened(const Piece& piece, double depth_u, double depth_v) {
  const Vec3 u{piece.a.middle_slope(0), piece.b.middle_slope(0), depth_u * piece.width_u};
  const Vec3 v{piece.a.middle_slope(1), piece.b.middle_slope(1), depth_v * piece.width_v};
  const double determinant = u.x * v.y - u.y * v.x, inverse = 1 / determinant;
  if (!(std::abs(determinant) > kLeastSine * length(u) * length(v))) return std::nullopt;
  NearIdentity f{combined(v.y * inverse, piece.a, -v.x * inverse, piece.b),
                 combined(-u.y * inverse, piece.a, u.x * inverse, piece.b), 0,
                 (std::abs(v.y) + std::abs(v.x)) * std::abs(inverse) * kHair,
                 (std::abs(u.y) + std::abs(u.x)) * std::abs(inverse) * kHair};
  f.deviation = std::max(f.x.slope_deviation(0, 1) + f.x.slope_deviation(1, 0),
                         f.y.slope_deviation(0, 0) + f.y.slope_deviation(1, 1));
  return f;
}

void add_place(std::vector<Place>& places, const Place& place) {
  constexpr double kSamePlace = 1e-9;
  for (const Place& other : places) {
    if (std::abs(other.u - place.u) + std::abs(other.v - place.v) < kSamePlace) return;
  }
  places.push_back(place);
}

/// Whether a piece that is a point as seen along the line is one: an edge that is shrunk to it.
bool is_point(const Piece& piece, const Depth& depth) {
  constexpr double kFar = 1e-9;
  const double middle = depth.at(piece.at(0.5, 0.5));
  for (const double x : {0, 1}) {
    for (const double y : {0, 1}) {
      if (std::abs(depth.at(piece.at(x, y)) - middle) >= kFar) return false;
    }
  }
  return true;
}

/// Adds the zero of a piece that has one at most. Of others the axis, 0 or 1, along which to halve
/// them.
std::optional<int> axis_if_undecided(const Piece& piece, const Depth& depth, double depth_u,
                                     double depth_v, std::vector<Place>& places) {
  if (piece.a.largest() < kHair && piece.b.largest() < kHair) {
    if (is_point(piece, depth)) add_place(places, piece.at(0.5, 0.5));
    return std::nullopt;
  }
  const auto f = straightened(piece, depth_u, depth_v);
  if (!f) {
    const auto length = [&](int axis) {
      return piece.a.slope_deviation(axis, 0) + piece.b.slope_deviation(axis, 0);
    };
    return length(0) >= length(1) ? 0 : 1;
  }
  if (!f->x.may_vanish(f->slack_x) || !f->y.may_vanish(f->slack_y)) return std::nullopt;
  if (f->deviation <= NearIdentity::kMost) {
    Place zero{0.5, 0.5};
    const NearIdentity::Zeros zeros = f->search(zero);
    if (zeros == NearIdentity::Zeros::one) add_place(places, piece.at(zero.u, zero.v));
    if (zeros != NearIdentity::Zeros::unknown) return std::nullopt;
  }
  return unevenness(f->x, f->y, 0) >= unevenness(f->x, f->y, 1) ? 0 : 1;
}

}  // namespace

void add_common_zeros(const Bicubic& a, const Bicubic& b, const Depth& depth,
                      std::vector<Place>& places) {
  thread_local std::vector<Piece> pieces, halves;
  pieces.assign(1, {a, b, {0, 0}, 1, 1});
  if (!pieces.front().may_vanish()) return;
  const double depth_u = depth.scaled.slope_deviation(0, 0);
  const double depth_v = depth.scaled.slope_deviation(1, 0);
  for (int i = 0; i < kMostHalvings && pieces.size() <= kMostPieces; ++i) {
    halves.clear();
    for (const Piece& piece : pieces) {
      const auto axis = axis_if_undecided(piece, depth, depth_u, depth_v, places);
      if (!axis) continue;
      const auto of_a = piece.a.split(*axis, 0.5), of_b = piece.b.split(*axis, 0.5);
      Piece half = piece;
      (*axis == 0 ? half.width_u : half.width_v) *= 0.5;
      for (std::size_t k = 0; k < 2; ++k) {
        half.a = of_a[k], half.b = of_b[k];
        if (half.may_vanish()) halves.push_back(half);
        (*axis == 0 ? half.corner.u : half.corner.v) += *axis == 0 ? half.width_u : half.width_v;
      }
    }
    pieces.swap(halves);
  }
}

}  // namespace isolux
