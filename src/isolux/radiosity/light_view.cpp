#include "isolux/radiosity/light_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/radiosity/form_factor.h"

namespace isolux {
namespace {

using Seen = ShadowSearch::Seen;

/// Whether the lattice is coarse as seen from here, or the horizon cuts it.
bool near(const Piece& piece, const Receiver& r) {
  const double size = distance(piece.corners[0], piece.corners[2]);
  return distance((piece.corners[0] + piece.corners[2]) * 0.5, r.point) < 1.5 * size ||
         std::any_of(piece.polygon().begin(), piece.polygon().end(),
                     [&](const Vec3& corner) { return dot(corner - r.point, r.normal) <= 0; });
}

/// Whether some of the ball stands above the receiver's horizon, and the receiver outside.
bool may_see(const Ball& ball, const Receiver& receiver, double epsilon) {
  const Vec3 way = ball.center - receiver.point;
  return length(way) > ball.radius + epsilon && dot(way, receiver.normal) + ball.radius > epsilon;
}

}  // namespace

void LightView::light_up(const LightLattice& light, std::span<const Receiver> receivers,
                         std::span<Rgb> irradiance, std::span<double> variance) {
  light_ = &light;
  if (!find_viewers(receivers)) return;
  const Blockers between = blockers();
  seen_ = between.none() ? Seen::all : search_.search(light, viewers_, between, precision_);
  if (seen_ == Seen::none) return;
  for (std::size_t k = 0; k < viewers_.size(); ++k) {
    Sum sum;
    if (light.ball) add_ball(k, sum);
    for (const Piece& piece : light.pieces) {
      if (may_see(piece, viewers_[k].receiver)) add_piece(piece, k, sum);
    }
    irradiance[who_[k]] += light.exitance * sum.factor;
    sum.variance += sum.shift * sum.shift;
    sum.variance += light.flatness * light.flatness * sum.factor * sum.factor;
    const double m = luminance(light.exitance);
    variance[who_[k]] += m * m * sum.variance;
  }
}

/// Whether there are any.
bool LightView::find_viewers(std::span<const Receiver> receivers) {
  viewers_.clear();
  who_.clear();
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const Receiver& r = receivers[i];
    const bool sees = light_->ball
                          ? isolux::may_see(*light_->ball, r, rays_.epsilon())
                          : std::any_of(light_->pieces.begin(), light_->pieces.end(),
                                        [&](const Piece& piece) { return may_see(piece, r); });
    if (!sees) continue;
    who_.push_back(i);
    viewers_.push_back({r, r.point + r.normal * rays_.epsilon(), {}});
    if (light_->ball) viewers_.back().ball.emplace(r, *light_->ball);
  }
  return !viewers_.empty();
}

/// Whether some of the piece stands above the receiver's horizon, and the receiver before it.
bool LightView::may_see(const Piece& piece, const Receiver& receiver) const {
  const double epsilon = rays_.epsilon();
  if (piece.before(receiver.point) <= epsilon) return false;
  return std::any_of(
      piece.corners.begin(), piece.corners.begin() + piece.corner_count,
      [&](const Vec3& corner) { return dot(corner - receiver.point, receiver.normal) > epsilon; });
}

/// What may stand between the viewers and the light. A ball does not hide what is seen of it.
Blockers LightView::blockers() const {
  Bounds starts, targets = light_->ball ? Bounds{} : light_->bounds;
  for (const Viewer& viewer : viewers_) {
    starts.include(viewer.receiver.point);
    if (viewer.ball) targets.include(viewer.ball->bounds());
  }
  if (!light_->ball) return rays_.blockers(starts, targets);
  return rays_.blockers(starts, targets, light_->object);
}

/// Adds what viewer k sees of the piece.
void LightView::add_piece(const Piece& piece, std::size_t k, Sum& sum) const {
  const Receiver& r = viewers_[k].receiver;
  if (seen_ == Seen::all) {
    sum.factor += form_factor(r.point, r.normal, piece.polygon());
    return;
  }
  // Far away the closed form of the whole counts, times the part that is seen by the measure of
  // thin pencils: cos cos' / r² changes so little within a lattice triangle that its middle
  // stands for it. Near by, or on the horizon, each seen part is measured by itself.
  const bool thin = !near(piece, r);
  Weights weights;
  for (std::uint32_t t = piece.first; t < piece.end; ++t) {
    const LatticeTriangle& triangle = light_->triangles[t];
    const int corners = search_.seen_corners(k, triangle);
    if (!thin && corners == 0) continue;
    const double weight = thin ? pencil(triangle, r) : exact(triangle, r);
    weights.whole += weight;
    if (corners == 3) weights.seen += weight;
    if (corners == 0 || corners == 3) continue;
    const EdgeCut cut = search_.cut_of(k, triangle);
    add_cut(cut, search_.bow(k, t), weight,
            thin ? weight * cut.seen_part() : exact_part(triangle, cut, r), weights);
  }
  if (!(weights.seen > 0)) return;
  const double scale = thin ? form_factor(r.point, r.normal, piece.polygon()) / weights.whole : 1;
  sum.factor += scale * weights.seen;
  sum.variance += scale * scale * weights.spread;
  sum.shift += scale * weights.shared;
}

/// Adds what viewer k sees of a ball: the closed form of the whole, times the part that is seen by
/// solid angle and the cosine at the receiver.
void LightView::add_ball(std::size_t k, Sum& sum) const {
  const BallView& ball = *viewers_[k].ball;
  if (seen_ == Seen::all) {
    sum.factor += ball.form_factor();
    return;
  }
  const auto measure = [&](double area, const Vec3& middle) {
    return area * std::max(0.0, ball.cosine(middle));
  };
  Weights weights;
  for (std::uint32_t t = 0; t < light_->triangles.size(); ++t) {
    const LatticeTriangle& triangle = light_->triangles[t];
    const double weight = measure(triangle.area, middle(triangle));
    weights.whole += weight;
    const int corners = search_.seen_corners(k, triangle);
    if (corners == 3) weights.seen += weight;
    if (corners == 0 || corners == 3) continue;
    // From close by the cosine may change much within the triangle.
    const EdgeCut cut = search_.cut_of(k, triangle);
    const auto corner = [&](std::size_t i) { return light_->points[triangle.points[i % 3]]; };
    const Vec3 tip = corner(cut.odd);
    const Vec3 odd_middle =
        tip + ((corner(cut.odd + 1) - tip) * cut.next + (corner(cut.odd + 2) - tip) * cut.last) / 3;
    const double odd = measure(triangle.area * cut.next * cut.last, odd_middle);
    add_cut(cut, search_.bow(k, t), weight, cut.odd_seen ? odd : std::max(0.0, weight - odd),
            weights);
  }
  if (!(weights.seen > 0)) return;
  const double scale = ball.form_factor() / weights.whole;
  sum.factor += scale * std::min(weights.seen, weights.whole);
  sum.variance += scale * scale * weights.spread;
  sum.shift += scale * weights.shared;
}

/// Adds a triangle that an edge cuts: its weight, what is seen of that up to the edge's chord, and
/// how far the edge bows out of it.
void LightView::add_cut(const EdgeCut& cut, double bow, double weight, double seen,
                        Weights& weights) const {
  constexpr double kBowDoubt = 0.35;
  const double part = cut.seen_part(), signed_bow = cut.odd_seen ? bow : -bow;
  weights.seen += seen;
  weights.seen += weight * (std::clamp(part + signed_bow, 0.0, 1.0) - part);
  const double bent = weight * (precision_.bent() + kBowDoubt * std::abs(bow));
  weights.spread += bent * bent;
  weights.shared += weight * (cut.next + cut.last) * precision_.cut();
}

double LightView::exact(const LatticeTriangle& triangle, const Receiver& r) const {
  const auto& [a, b, c] = triangle.points;
  const std::array<Vec3, 3> corners{light_->points[a], light_->points[b], light_->points[c]};
  return form_factor(r.point, r.normal, corners);
}

double LightView::exact_part(const LatticeTriangle& triangle, const EdgeCut& cut,
                             const Receiver& r) const {
  const Vec3& tip = light_->points[triangle.points[cut.odd]];
  const Vec3& next = light_->points[triangle.points[(cut.odd + 1) % 3]];
  const Vec3& last = light_->points[triangle.points[(cut.odd + 2) % 3]];
  const Vec3 on_next = tip + (next - tip) * cut.next, on_last = tip + (last - tip) * cut.last;
  if (cut.odd_seen) return form_factor(r.point, r.normal, std::array{tip, on_next, on_last});
  return form_factor(r.point, r.normal, std::array{on_next, next, last, on_last});
}

/// cos cos' A / (π r²) of the triangle's middle.
double LightView::pencil(const LatticeTriangle& triangle, const Receiver& r) const {
  const Vec3 d = middle(triangle) - r.point;
  const double squared = length_squared(d);
  return std::max(0.0, dot(d, r.normal)) * std::max(0.0, -dot(d, triangle.normal)) * triangle.area /
         (std::numbers::pi * squared * squared);
}

Vec3 LightView::middle(const LatticeTriangle& triangle) const {
  const auto& [a, b, c] = triangle.points;
  return (light_->points[a] + light_->points[b] + light_->points[c]) / 3;
}

}  // namespace isolux
