#include "isolux/radiosity/hemisphere_rays.h"

#include <cmath>
#include <numbers>

namespace isolux {
namespace {

// Points this close to the rim would give rays inside the surface they start from.
constexpr double kRim = 0.99995;

Point2 turned(const Point2& p, double cosine, double sine) {
  return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
}

}  // namespace

HemisphereRays::HemisphereRays(const Receiver& receiver, double lift, int grid, Random& random)
    : frame_(receiver.normal),
      origin_(receiver.point + receiver.normal * lift),
      grid_(grid),
      random_(random) {
  const double turn = 2 * std::numbers::pi * random.uniform();
  cosine_ = std::cos(turn);
  sine_ = std::sin(turn);
}

Point2 HemisphereRays::square_of(const Vec3& direction) const {
  const Point2 p = turned({dot(direction, frame_.u), dot(direction, frame_.v)}, cosine_, -sine_);
  const double off = std::hypot(p.x, p.y);
  return disk_to_square(off > 1 ? Point2{p.x / off, p.y / off} : p);
}

void HemisphereRays::send(double i, double j) {
  const Point2 square{2 * i / grid_ - 1, 2 * j / grid_ - 1};
  const Point2 p = turned(square_to_disk({square.x * kRim, square.y * kRim}), cosine_, sine_);
  const double squared = p.x * p.x + p.y * p.y;
  rays_.push_back({origin_, frame_.to_world({p.x, p.y, std::sqrt(1 - squared)})});
}

void HemisphereRays::send_to_cells() {
  for (int j = 0; j < grid_; ++j) {
    for (int i = 0; i < grid_; ++i) {
      const double x = i + random_.uniform();
      send(x, j + random_.uniform());
    }
  }
}

void HemisphereRays::send_to_parts(const DividedCell& divided) {
  const auto& [cell, parts] = divided;
  for (int j = 0; j < parts; ++j) {
    for (int i = 0; i < parts; ++i) {
      const double x = cell % grid_ + (i + random_.uniform()) / parts;
      send(x, cell / grid_ + (j + random_.uniform()) / parts);
    }
  }
}

}  // namespace isolux
