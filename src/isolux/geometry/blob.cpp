#include "isolux/geometry/blob.h"

#include <fmt/format.h>

#include <algorithm>

#include "isolux/core/error.h"
#include "isolux/geometry/bracketed_root.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"

namespace isolux {

// Notation (local frame, lengths in units of half the blob's diagonal)
//   o + s d     the line, o its point nearest to the blob's middle, |d| = 1
//   m, h        middle of a ball's chord on the line and half its length
//   q(s)        = (h² − (s − m)²) / R²: what 1 − d²/R² is along the line
//   f(s)        = Σ strength q² − threshold, over the balls whose chord holds s
// Between two neighbouring ends of chords f is one quartic. Between two neighbouring zeros of its
// derivative that is monotonic, so that a change of sign brackets exactly one root.

namespace {

struct Chord {
  double middle, half;
  double inverse;  ///< 1 / R²
  double strength;

  double q(double s) const { return (half - (s - middle)) * (half + (s - middle)) * inverse; }
};

/// The field of the chords less the threshold, at s.
ValueAndSlope field(const std::vector<Chord>& chords, double threshold, double s) {
  ValueAndSlope f{-threshold, 0};
  for (const Chord& chord : chords) {
    const double q = chord.q(s);
    f.value += chord.strength * q * q;
    f.slope -= 4 * chord.strength * q * (s - chord.middle) * chord.inverse;
  }
  return f;
}

/// A cubic c[0] + c[1] v + c[2] v² + c[3] v³ on [−1, 1].
struct Cubic {
  double c[4] = {};

  ValueAndSlope operator()(double v) const {
    return {((c[3] * v + c[2]) * v + c[1]) * v + c[0], (3 * c[3] * v + 2 * c[2]) * v + c[1]};
  }
};

/// Ends of intervals of [−1, 1], in ascending order.
struct Ends {
  double at[5];
  int count = 0;

  void add(double v) { at[count++] = v; }
};

/// The intervals on which a cubic is monotonic.
Ends monotonic_pieces(const Cubic& cubic) {
  const double a = 3 * cubic.c[3], b = cubic.c[2], c = cubic.c[1];  // a v² + 2 b v + c
  Ends ends;
  ends.add(-1);
  const double discriminant = b * b - a * c;
  if (discriminant > 0) {
    const double sum = -(b + std::copysign(std::sqrt(discriminant), b));
    double first = sum / a, second = c / sum;
    if (!(first < second)) std::swap(first, second);
    for (const double v : {first, second}) {
      if (v > ends.at[ends.count - 1] && v < 1) ends.add(v);
    }
  }
  ends.add(1);
  return ends;
}

/// The intervals of [−1, 1] on which the chords' field is monotonic as a function of v, the place
/// on the line being middle + width v.
Ends monotonic_pieces(const std::vector<Chord>& chords, double middle, double width) {
  Cubic slope;
  for (const Chord& chord : chords) {
    const double from = middle - chord.middle;
    const double q0 = chord.q(middle);
    const double q1 = -2 * width * from * chord.inverse;
    const double q2 = -width * width * chord.inverse;
    slope.c[0] += chord.strength * 2 * q0 * q1;
    slope.c[1] += chord.strength * 2 * (q1 * q1 + 2 * q0 * q2);
    slope.c[2] += chord.strength * 6 * q1 * q2;
    slope.c[3] += chord.strength * 4 * q2 * q2;
  }
  const Ends bends = monotonic_pieces(slope);
  Ends ends;
  ends.add(-1);
  for (int i = 0; i + 1 < bends.count; ++i) {
    const double a = bends.at[i], b = bends.at[i + 1];
    const bool rising = slope(a).value < 0;
    if (rising != (slope(b).value < 0)) ends.add(bracketed_root(slope, a, b, rising));
  }
  ends.add(1);
  return ends;
}

}  // namespace

Blob::Blob(double threshold, std::vector<BlobBall> balls)
    : threshold_(threshold), given_(std::move(balls)), balls_(given_) {
  double most = 0;
  std::size_t swelling = 0;
  for (const BlobBall& ball : balls_) {
    require_point(ball.center, "center");
    require_length(ball.radius, "radius");
    if (!(std::abs(ball.strength) <= 1e12) || ball.strength == 0) {
      throw InputError(
          fmt::format("strength: must be a number within 1e12 and not 0, not {}", ball.strength));
    }
    if (ball.strength > 0) most += ball.strength, ++swelling;
  }
  if (!(threshold > 0 && threshold < most)) {
    throw InputError(fmt::format(
        "threshold: must be more than 0 and less than all strengths together, {}, not {}", most,
        threshold));
  }
  // On the surface at least one ball adds its share of the threshold.
  const double share = threshold / static_cast<double>(swelling);
  for (const BlobBall& ball : balls_) {
    if (!(ball.strength > share)) continue;
    const double reach = ball.radius * std::sqrt(1 - std::sqrt(share / ball.strength));
    const Vec3 half = Vec3{1, 1, 1} * reach;
    bounds_.include({ball.center - half, ball.center + half});
  }
  center_ = bounds_.center();
  unit_ = std::max(0.5 * bounds_.diagonal(), kShortestLength);
  for (BlobBall& ball : balls_) ball.center = local(ball.center), ball.radius /= unit_;
}

ShapeDescription Blob::describe() const {
  std::vector<ShapeDescription::Record> balls;
  for (const auto& [center, radius, strength] : given_) {
    balls.push_back({{"center", center}, {"radius", radius}, {"strength", strength}});
  }
  return {"blob", {{"threshold", threshold_}, {"balls", std::move(balls)}}, {}, {}};
}

void Blob::intersect(const Ray& ray, Hits& hits) const {
  const double speed = length(ray.direction);
  const Vec3 d = ray.direction / speed;
  const double shift = dot(center_ - ray.origin, d);
  const Vec3 o = local(ray.origin + d * shift);

  thread_local std::vector<Chord> chords, here;
  thread_local std::vector<double> ends;
  chords.clear(), ends.clear();
  for (const BlobBall& ball : balls_) {
    const double middle = dot(ball.center - o, d);
    const double missing = length(ball.center - o - d * middle);
    const double half_squared = (ball.radius - missing) * (ball.radius + missing);
    if (!(half_squared > 0)) continue;
    const double half = std::sqrt(half_squared);
    chords.push_back({middle, half, 1 / (ball.radius * ball.radius), ball.strength});
    ends.push_back(middle - half), ends.push_back(middle + half);
  }
  std::sort(ends.begin(), ends.end());

  // What ends one interval inside begins the next so, whatever rounding says there.
  bool inside = false;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double middle = 0.5 * (ends[i] + ends[i + 1]), width = 0.5 * (ends[i + 1] - ends[i]);
    if (!(width > 0)) continue;
    here.clear();
    for (const Chord& chord : chords) {
      if (std::abs(middle - chord.middle) < chord.half) here.push_back(chord);
    }
    const auto f = [&](double s) { return field(here, threshold_, s); };
    const Ends pieces = monotonic_pieces(here, middle, width);
    for (int k = 0; k + 1 < pieces.count; ++k) {
      const bool last = k + 2 == pieces.count;
      const double a = middle + width * pieces.at[k];
      const double b = last ? ends[i + 1] : middle + width * pieces.at[k + 1];
      const bool inside_after = b < ends.back() && f(b).value > 0;
      if (inside_after == inside) continue;
      inside = inside_after;
      const double s = bracketed_root(f, a, b, inside);
      const Vec3 p = o + d * s;
      hits.push_back(
          {(shift + s * unit_) / speed, center_ + p * unit_, outward(p, inside ? -d : d), 0});
    }
  }
}

/// The unit normal there, or `otherwise` where the field has no slope.
Vec3 Blob::outward(const Vec3& local_point, const Vec3& otherwise) const {
  Vec3 sum;
  for (const BlobBall& ball : balls_) {
    const Vec3 away = (local_point - ball.center) / ball.radius;
    const double q = 1 - length_squared(away);
    if (q > 0) sum += away * (ball.strength * q / ball.radius);
  }
  const double size = length(sum);
  return size > 0 ? sum / size : otherwise;
}

bool Blob::contains(const Vec3& point) const {
  const Vec3 p = local(point);
  double sum = 0;
  for (const BlobBall& ball : balls_) {
    const double q = 1 - length_squared((p - ball.center) / ball.radius);
    if (q > 0) sum += ball.strength * q * q;
  }
  return sum > threshold_;
}

}  // namespace isolux
