#include "isolux/geometry/instance.h"

#include "isolux/core/error.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {

Instance::Instance(std::shared_ptr<const Shape> shape, const Affine& map)
    : shape_(std::move(shape)), map_(map) {
  if (!shape_) throw InputError("an instance needs a shape");
  for (const Vec3& row : map.linear) require_point(row, "transform");
  require_point(map.translation, "transform");
  const auto inverse = map.inverse();
  if (!inverse) {
    throw InputError("transform: flattens the shape; use scale factors that are not 0");
  }
  inverse_ = *inverse;
}

Ray Instance::to_shape(const Ray& ray) const {
  return {inverse_.point(ray.origin), inverse_.vector(ray.direction)};
}

void Instance::to_world(Hits& hits, std::size_t first) const {
  for (std::size_t i = first; i < hits.size(); ++i) {
    hits[i].point = map_.point(hits[i].point);
    hits[i].normal = normalized(inverse_.transposed(hits[i].normal));
  }
}

Bounds Instance::mapped(const Bounds& box) const {
  Bounds result;
  for (int corner = 0; corner < 8; ++corner) {
    result.include(
        map_.point({corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                    corner & 4 ? box.upper.z : box.lower.z}));
  }
  return result;
}

void Instance::intersect(const Ray& ray, Hits& hits) const {
  const std::size_t first = hits.size();
  shape_->intersect(to_shape(ray), hits);
  to_world(hits, first);
}

bool Instance::occludes(const Ray& ray, double t_min, double t_max) const {
  return shape_->occludes(to_shape(ray), t_min, t_max);
}

bool Instance::contains(const Vec3& point) const { return shape_->contains(inverse_.point(point)); }

std::optional<double> Instance::area() const {
  const auto original = shape_->area();
  const auto factor = map_.similarity();
  if (!original || !factor) return std::nullopt;
  return *original * *factor * *factor;
}

std::optional<TriangleSoup> Instance::triangulate(double max_edge) const {
  // No direction is stretched more than by the norm of the matrix, found here by its upper bound.
  const auto& rows = map_.linear;
  const double stretch = map_.similarity().value_or(
      std::sqrt(length_squared(rows[0]) + length_squared(rows[1]) + length_squared(rows[2])));
  auto soup = shape_->triangulate(max_edge / stretch);
  if (!soup) return soup;
  for (Vec3& p : soup->points) p = map_.point(p);
  if (map_.determinant() < 0) flip(*soup);
  return soup;
}

void Instance::intersect_part(std::size_t part, const Ray& ray, Hits& hits) const {
  const std::size_t first = hits.size();
  shape_->intersect_part(part, to_shape(ray), hits);
  to_world(hits, first);
}

bool Instance::part_occludes(std::size_t part, const Ray& ray, double t_min, double t_max) const {
  return shape_->part_occludes(part, to_shape(ray), t_min, t_max);
}

ShapeDescription Instance::describe() const {
  ShapeDescription shape = shape_->describe();
  shape.transform = shape.transform ? map_ * *shape.transform : map_;
  return shape;
}

Original original(std::shared_ptr<const Shape> shape) {
  std::vector<Affine> maps;  // from the outermost
  while (const auto* const instance = dynamic_cast<const Instance*>(shape.get())) {
    maps.push_back(instance->map());
    shape = std::shared_ptr<const Shape>(instance->shape());
  }
  Original result{std::move(shape), {}};
  for (; !maps.empty(); maps.pop_back()) {
    result.map = result.map ? maps.back() * *result.map : maps.back();
  }
  return result;
}

}  // namespace isolux
