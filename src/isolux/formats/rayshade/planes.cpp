#include "isolux/formats/rayshade/planes.h"

#include "isolux/geometry/box.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/parallelogram.h"

namespace isolux::rayshade {

Plane mapped(const Plane& plane, const Affine& map) {
  const Affine inverse = map.inverse().value_or(Affine{});
  return {map.point(plane.point), normalized(inverse.transposed(plane.normal))};
}

ShapePtr PlaneCut::square(const Plane& plane, const Affine& map) const {
  const Plane world = mapped(plane, map);
  const Frame frame(world.normal);
  const Vec3 u = frame.u * side, v = frame.v * side;
  return std::make_shared<Parallelogram>(foot_on(world, middle) - (u + v) * 0.5, u, v);
}

ShapePtr PlaneCut::half_space(const Plane& plane, const Affine& map) const {
  const Plane world = mapped(plane, map);
  const Frame frame(world.normal);
  Affine place;
  for (int i = 0; i < 3; ++i) place.linear[i] = Vec3{frame.u[i], frame.v[i], frame.n[i]};
  place.translation = foot_on(world, middle);
  const double half = 0.5 * side;
  const auto cube = std::make_shared<Box>(Vec3{-half, -half, -side}, Vec3{half, half, 0});
  return std::make_shared<Instance>(cube, map.inverse().value_or(Affine{}) * place);
}

}  // namespace isolux::rayshade
