#include "isolux/geometry/patch_piece.h"

namespace isolux {
namespace {

/// p a + q b + r c.
Bicubic combined(double p, const Bicubic& a, double q, const Bicubic& b, double r,
                 const Bicubic& c) {
  Bicubic sum;
  for (std::size_t i = 0; i < 16; ++i) sum.c[i] = p * a.c[i] + q * b.c[i] + r * c.c[i];
  return sum;
}

/// a − p b − q c.
Bicubic less(const Bicubic& a, double p, const Bicubic& b, double q, const Bicubic& c) {
  Bicubic rest;
  for (std::size_t i = 0; i < 16; ++i) rest.c[i] = a.c[i] - p * b.c[i] - q * c.c[i];
  return rest;
}

double bend(const Bicubic& f, double along_u, double along_v) {
  return f.slope_deviation(0, along_u) + f.slope_deviation(1, along_v);
}

}  // namespace

RationalPatch::PointAndSlopes RationalPatch::at(const Place& place) const {
  const CubicBasis u(place.u), v(place.v);
  const auto weight = part[3].slopes_at(u, v);
  PointAndSlopes result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [value, along_u, along_v] = part[axis].slopes_at(u, v);
    const double coordinate = value / weight.value;
    result.point[axis] = coordinate;
    result.along_u[axis] = (along_u - coordinate * weight.along_u) / weight.value;
    result.along_v[axis] = (along_v - coordinate * weight.along_v) / weight.value;
  }
  return result;
}

std::array<RationalPatch, 2> RationalPatch::split(int axis, double t) const {
  std::array<RationalPatch, 2> both;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto parts = part[k].split(axis, t);
    both[0].part[k] = parts[0], both[1].part[k] = parts[1];
  }
  return both;
}

PatchPiece::PatchPiece(const RationalPatch& patch) {
  const auto center = patch.at({0.5, 0.5});
  middle_ = center.point;
  u_ = center.along_u, v_ = center.along_v;
  const Vec3 product = cross(u_, v_);
  const bool regular = length(product) > 1e-6 * length(u_) * length(v_) && length(product) > 1e-20;
  if (!regular) u_ = {1, 0, 0}, v_ = {0, 1, 0};
  const double area = length(cross(u_, v_));
  normal_ = cross(u_, v_) / area;
  x_axis_ = cross(v_, normal_) / area;
  y_axis_ = cross(normal_, u_) / area;

  const CubicBasis half(0.5);
  const double scale = 1 / patch.part[3].at(half, half);
  const auto infinity = std::numeric_limits<double>::infinity();
  Vec3 least{infinity, infinity, infinity}, most = -least;
  for (std::size_t i = 0; i < 16; ++i) {
    const Vec3 p = patch.point(i), off = p - middle_;
    const Vec3 place{dot(x_axis_, off), dot(y_axis_, off), dot(normal_, off)};
    const double w = weight_.c[i] = patch.part[3].c[i] * scale;
    x_.c[i] = place.x * w, y_.c[i] = place.y * w, h_.c[i] = place.z * w;
    least = min(least, place), most = max(most, place);
    bounds_.include(p);
  }
  const auto range = [&](int axis, double unit) {
    constexpr double kRoom = 1e-9, kLeastRoom = 1e-13;
    return Range{0.5 * (least[axis] + most[axis]),
                 (0.5 + kRoom) * (most[axis] - least[axis]) + kLeastRoom * unit};
  };
  x_range_ = range(0, length(x_axis_)), y_range_ = range(1, length(y_axis_));
  h_range_ = range(2, 1);
  x_bend_ = regular ? bend(x_, 1, 0) : infinity;
  y_bend_ = bend(y_, 0, 1);
  h_bend_ = bend(h_, 0, 0), weight_bend_ = bend(weight_, 0, 0);
}

constexpr double kSteep = 2.5;  ///< the tangent of the angle off the normal that many lines have

bool PatchPiece::flat() const {
  const double along_x = x_bend_ + kSteep * length(x_axis_) * h_bend_;
  const double along_y = y_bend_ + kSteep * length(y_axis_) * h_bend_;
  return std::max(along_x, along_y) + 0.5 * weight_bend_ <= NearIdentity::kMost;
}

int PatchPiece::bent_axis() const {
  Bicubic x_tilt = h_, y_tilt = h_;
  for (double& c : x_tilt.c) c *= kSteep * length(x_axis_);
  for (double& c : y_tilt.c) c *= kSteep * length(y_axis_);
  const auto uneven = [&](int axis) {
    return std::max(unevenness(x_, y_, axis), unevenness(x_tilt, y_tilt, axis));
  };
  return uneven(0) >= uneven(1) ? 0 : 1;
}

void PatchPiece::find(const Ray& line, std::vector<Place>& places) const {
  const Vec3 from = line.origin - middle_;
  const double sine = dot(normal_, line.direction);
  if (!(std::abs(sine) > kLeastSine)) return search(line, places);
  // The line is at (x + x_slope h, y + y_slope h) at the height h.
  const double climb = 1 / sine, height = dot(normal_, from);
  const double x_slope = dot(x_axis_, line.direction) * climb;
  const double y_slope = dot(y_axis_, line.direction) * climb;
  const double x = dot(x_axis_, from) - x_slope * height;
  const double y = dot(y_axis_, from) - y_slope * height;
  const auto passes_by = [&](double at, double slope, const Range& range) {
    return std::abs(at + slope * h_range_.middle - range.middle) >
           range.half_width + std::abs(slope) * h_range_.half_width;
  };
  if (passes_by(x, x_slope, x_range_) || passes_by(y, y_slope, y_range_)) return;

  const double deviation =
      std::max(x_bend_ + std::abs(x) * weight_bend_ + std::abs(x_slope) * h_bend_,
               y_bend_ + std::abs(y) * weight_bend_ + std::abs(y_slope) * h_bend_);
  if (deviation <= NearIdentity::kMost) {
    const NearIdentity f{less(x_, x, weight_, x_slope, h_), less(y_, y, weight_, y_slope, h_),
                         deviation, kHair * length(x_axis_ - normal_ * x_slope),
                         kHair * length(y_axis_ - normal_ * y_slope)};
    Place zero{std::clamp(0.5 + x, 0.0, 1.0), std::clamp(0.5 + y, 0.0, 1.0)};
    const NearIdentity::Zeros zeros = f.search(zero);
    if (zeros == NearIdentity::Zeros::one) places.push_back(zero);
    if (zeros != NearIdentity::Zeros::unknown) return;
  }
  search(line, places);
}

void PatchPiece::search(const Ray& line, std::vector<Place>& places) const {
  const Vec3 from = line.origin - middle_;
  const auto along = [&](const Vec3& axis) {
    Bicubic f = combined(dot(axis, u_), x_, dot(axis, v_), y_, dot(axis, normal_), h_);
    for (std::size_t i = 0; i < 16; ++i) f.c[i] -= dot(axis, from) * weight_.c[i];
    return f;
  };
  // Across the line one along the piece and one off it, since that shows soonest where it passes
  // by.
  const Vec3& d = line.direction;
  const Vec3 product = cross(d, normal_);
  const Vec3 across = length(product) > 0.1 ? normalized(product) : Frame(d).u;
  add_common_zeros(along(across), along(cross(d, across)), {along(d), weight_}, places);
}

Vec3 PatchPiece::point(const Place& place) const {
  const CubicBasis u(place.u), v(place.v);
  return middle_ + to_world(x_.at(u, v), y_.at(u, v), h_.at(u, v)) / weight_.at(u, v);
}

std::optional<Vec3> PatchPiece::normal(const Place& place) const {
  for (const double inward : {0.0, 1e-6, 1e-3}) {
    const CubicBasis u(place.u + (0.5 - place.u) * inward), v(place.v + (0.5 - place.v) * inward);
    const auto x = x_.slopes_at(u, v), y = y_.slopes_at(u, v), h = h_.slopes_at(u, v);
    const auto w = weight_.slopes_at(u, v);
    const Vec3 off = to_world(x.value, y.value, h.value) / w.value;
    // Both slopes times the weight.
    const Vec3 along_u = to_world(x.along_u, y.along_u, h.along_u) - off * w.along_u;
    const Vec3 along_v = to_world(x.along_v, y.along_v, h.along_v) - off * w.along_v;
    const Vec3 normal = cross(along_u, along_v);
    const double size = length(normal);
    if (size > 1e-10 * length(along_u) * length(along_v) && size > 1e-20) return normal / size;
  }
  return std::nullopt;
}

}  // namespace isolux
