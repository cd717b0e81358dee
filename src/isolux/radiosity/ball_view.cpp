#include "isolux/radiosity/ball_view.h"

namespace isolux {

// Notation
//   q            a point of the disk, s = |q|²
//   θ, α         angle from the way to the centre, at the rim: 1 − cos θ = s (1 − cos α)

BallView::BallView(const Receiver& receiver, const Ball& ball)
    : receiver_(receiver),
      ball_(ball),
      distance_(distance(ball.center, receiver.point)),
      frame_((ball.center - receiver.point) / distance_),
      form_factor_(sphere_form_factor(receiver.point, receiver.normal, ball.center, ball.radius)),
      above_horizon_(dot(ball.center - receiver.point, receiver.normal) >= ball.radius) {
  const double sine = ball.radius / distance_;
  versine_ = sine * sine / (1 + std::sqrt(std::max(0.0, 1 - sine * sine)));
}

Vec3 BallView::direction(const Vec3& on_disk) const {
  const double squared = length_squared(on_disk);
  const double s = std::min(1.0, squared), inward = squared > 1 ? 1 / std::sqrt(squared) : 1;
  const double sideways = inward * std::sqrt(versine_ * (2 - s * versine_));
  return frame_.to_world({on_disk.x * sideways, on_disk.y * sideways, 1 - s * versine_});
}

Vec3 BallView::point(const Vec3& on_disk) const {
  const Vec3 way = direction(on_disk);
  const Vec3 from_center = receiver_.point - ball_.center;
  const double middle = -dot(from_center, way);
  const double missing = length(from_center + way * middle);
  const double half_squared = (ball_.radius - missing) * (ball_.radius + missing);
  const Vec3 first = from_center + way * (middle - std::sqrt(std::max(0.0, half_squared)));
  return ball_.center + normalized(first) * (ball_.radius + ball_.lift);
}

Bounds BallView::bounds() const {
  // Along each axis the cap reaches as far as the ball, or as its rim, a circle of radius cos α at
  // the height sin α towards the receiver.
  const double rim_height = ball_.radius / distance_;
  const double rim_radius = std::sqrt(std::max(0.0, 1 - rim_height * rim_height));
  Vec3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const double up = -frame_.n[axis];  // the cosine between the axis and the cap's middle
    const double across = rim_radius * std::sqrt(std::max(0.0, 1 - up * up));
    high[axis] = up >= rim_height ? 1 : rim_height * up + across;
    low[axis] = -up >= rim_height ? -1 : rim_height * up - across;
  }
  const double radius = ball_.radius + ball_.lift;
  return {ball_.center + low * radius, ball_.center + high * radius};
}

}  // namespace isolux
