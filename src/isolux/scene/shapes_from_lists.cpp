#include "isolux/scene/shapes_from_lists.h"

#include "isolux/geometry/bezier.h"
#include "isolux/geometry/height_field.h"
#include "isolux/geometry/nurbs.h"
#include "isolux/geometry/polygon.h"
#include "isolux/geometry/prism.h"
#include "isolux/geometry/revolution.h"
#include "isolux/geometry/swept_sphere.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux {
namespace {

std::vector<Vec3> read_points(const Value& list, std::size_t least = 3) {
  std::vector<Vec3> points;
  for (const Value& point : list.items(least)) points.push_back(point.point());
  return points;
}

std::vector<std::vector<Vec3>> read_holes(const Fields& fields) {
  std::vector<std::vector<Vec3>> holes;
  if (const auto list = fields.find("holes")) {
    for (const Value& hole : list->items()) holes.push_back(read_points(hole));
  }
  return holes;
}

/// The surface, once its pieces are counted.
ShapePtr counted(const Value& place, ShapePtr patches) {
  try {
    place.pieces().add(patches->part_count());
  } catch (const InputError& error) {
    place.fail(error.what());
  }
  return patches;
}

KnotVector read_knots(const Value& degree, const Value& knots) {
  KnotVector vector{static_cast<std::size_t>(degree.integer(1, 3)), {}};
  for (const Value& knot : knots.items()) vector.knots.push_back(knot.number());
  return vector;
}

PrismTop read_prism_top(const Fields& fields) {
  PrismTop top{fields.require("center").point()};
  if (const auto scale = fields.find("scale")) {
    if (scale->is_list()) {
      const std::vector<Value> factors = scale->items(2, 2);
      top.scale = {factors[0].number(), factors[1].number()};
    } else {
      top.scale.fill(scale->number());
    }
  }
  if (const auto twist = fields.find("twist")) top.twist = twist->number();
  return top;
}

}  // namespace

ShapePtr read_polygon(const Value& value) {
  const Fields fields(value, {"points", "holes"});
  return make_shape<Polygon>(value, read_points(fields.require("points")), read_holes(fields));
}

ShapePtr read_mesh(const Value& value) {
  const Fields fields(value, {"points", "triangles"});
  TriangleSoup soup;
  soup.points = read_points(fields.require("points"));
  const int last = static_cast<int>(soup.points.size()) - 1;
  for (const Value& triangle : fields.require("triangles").items(1)) {
    const std::vector<Value> corners = triangle.items(3, 3);
    auto& indices = soup.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      indices[i] = static_cast<std::uint32_t>(corners[i].integer(0, last));
    }
  }
  return make_shape<TriangleMesh>(value, std::move(soup.points), std::move(soup.triangles));
}

ShapePtr read_prism(const Value& value) {
  const Fields fields(value, {"points", "holes", "along", "center", "scale", "twist"});
  std::optional<PrismTop> top;
  if (fields.find("center") || fields.find("scale") || fields.find("twist")) {
    top = read_prism_top(fields);
  }
  return make_shape<Prism>(value, read_points(fields.require("points")), read_holes(fields),
                           fields.require("along").point(), top);
}

ShapePtr read_revolution(const Value& value) {
  const Fields fields(value, {"center", "axis", "profile", "angle", "smooth", "open"});
  std::vector<ProfilePoint> profile;
  for (const Value& point : fields.require("profile").items(2)) {
    const std::vector<Value> numbers = point.items(2, 2);
    if (numbers[0].length() < 0) {
      numbers[0].fail(
          "the first number of a point of the 'profile', its distance from the axis, "
          "must not be negative");
    }
    profile.push_back({numbers[0].length(), numbers[1].length()});
  }
  RevolutionForm form;
  if (const auto angle = fields.find("angle")) form.angle = angle->number();
  form.smooth = read_flag(fields, "smooth");
  form.open = read_flag(fields, "open");
  return make_shape<Revolution>(value, fields.require("center").point(),
                                fields.require("axis").direction(), std::move(profile), form);
}

ShapePtr read_sweep(const Value& value) {
  const Fields fields(value, {"points", "radius", "radii", "loop"});
  std::vector<CurvePoint> points;
  for (const Vec3& point : read_points(fields.require("points"), 2)) points.push_back({point});
  const auto radius = fields.find("radius"), radii = fields.find("radii");
  if (radius.has_value() == radii.has_value()) {
    value.fail("'sweep' must have one of 'radius' and 'radii', one for each point");
  }
  if (radius) {
    for (CurvePoint& point : points) point.radius = radius->positive_length();
  } else {
    const std::vector<Value> list = radii->items(points.size(), points.size());
    for (std::size_t i = 0; i < list.size(); ++i) points[i].radius = list[i].positive_length();
  }
  return make_shape<SweptSphere>(value, std::move(points), read_flag(fields, "loop"));
}

ShapePtr read_height_field(const Value& value) {
  const Fields fields(value, {"corner", "u", "v", "heights"});
  std::vector<std::vector<double>> heights;
  for (const Value& row : fields.require("heights").items(2)) {
    auto& numbers = heights.emplace_back();
    for (const Value& height : row.items(2)) numbers.push_back(height.length());
  }
  return make_shape<HeightField>(value, fields.require("corner").point(),
                                 fields.require("u").point(), fields.require("v").point(),
                                 std::move(heights));
}

ShapePtr read_bezier(const Value& value) {
  const Fields fields(value, {"patches"});
  std::vector<std::vector<Vec3>> patches;
  for (const Value& patch : fields.require("patches").items(1)) {
    std::vector<Vec3>& points = patches.emplace_back();
    for (const Value& point : patch.items(16, 16)) points.push_back(point.point());
  }
  return counted(value, make_shape<Bezier>(value, std::move(patches)));
}

ShapePtr read_nurbs(const Value& value) {
  const Fields fields(value, {"degrees", "u_knots", "v_knots", "points", "weights"});
  const std::vector<Value> degrees = fields.require("degrees").items(2, 2);
  KnotVector u = read_knots(degrees[0], fields.require("u_knots"));
  KnotVector v = read_knots(degrees[1], fields.require("v_knots"));
  Nurbs::Points points;
  for (const Value& row : fields.require("points").items(2)) points.push_back(read_points(row, 2));
  Nurbs::Weights weights;
  if (const auto list = fields.find("weights")) {
    for (const Value& row : list->items(2)) {
      auto& numbers = weights.emplace_back();
      for (const Value& weight : row.items(2)) numbers.push_back(weight.number());
    }
  }
  return counted(value, make_shape<Nurbs>(value, std::move(u), std::move(v), std::move(points),
                                          std::move(weights)));
}

}  // namespace isolux
