#include "isolux/scene/shape_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "isolux/geometry/blob.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/frustum.h"
#include "isolux/geometry/implicit.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/reversed.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/torus.h"
#include "isolux/scene/light_reader.h"
#include "isolux/scene/make_shape.h"
#include "isolux/scene/shapes_from_lists.h"
#include "isolux/scene/spelling.h"
#include "isolux/scene/transform_reader.h"

namespace isolux {

/// Where in an object or a named shape a shape is read, and how much it holds so far.
struct ShapeNesting {
  const ShapeLibrary& library;
  int& deepest;
  std::size_t& count;
  std::vector<FaceRun>& faces;        ///< of all shapes read so far that hold no others
  const FindMaterial* find_material;  ///< null where parts have no materials
  std::optional<Finish> finish;       ///< of the shape around
  int depth = 0;

  /// Counts shapes that reach `more` levels further down.
  void enter(const Value& place, int more, std::size_t shapes) const;
  /// Takes the finish that a shape has of its own.
  void read_finish(const Fields& fields);
  /// The shape of that name.
  std::shared_ptr<const Shape> named(const Value& name) const;
};

namespace {

constexpr int kDeepestNesting = 100;             ///< of shapes within shapes
constexpr std::size_t kMostWithinOne = 100'000;  ///< shapes, where some have names

}  // namespace

void ShapeNesting::enter(const Value& place, int more, std::size_t shapes) const {
  deepest = std::max(deepest, depth + more);
  count += shapes;
  if (deepest > kDeepestNesting) {
    place.fail(
        fmt::format("shapes nested more than {} deep: a union, intersection or difference "
                    "takes any number, so list them side by side",
                    kDeepestNesting));
  }
  if (shapes > 1 && count > kMostWithinOne) {
    place.fail(fmt::format("more than {} shapes within one: make several objects", kMostWithinOne));
  }
}

void ShapeNesting::read_finish(const Fields& fields) {
  const std::optional<Value> material = fields.find("material"), emission = fields.find("emission");
  const std::optional<Value>& first = material ? material : emission;
  if (!first) return;
  if (!find_material) first->fail("a shape under 'shapes' looks as the objects say that it is in");
  if (depth == 1) first->fail("give it to the object: only what shapes are made of has its own");
  if (!material) emission->fail("a part that shines needs a 'material' of its own");
  finish = Finish{(*find_material)(*material), emission ? read_emission(*emission) : Rgb{}};
}

ShapePtr ShapeNesting::named(const Value& name) const {
  const auto found = library.named_.find(name.text());
  if (found == library.named_.end()) {
    std::vector<std::string_view> names;
    for (const auto& [known, shape] : library.named_) names.push_back(known);
    name.fail(fmt::format("no shape above is named {}: {}", in_quotes(name.text()),
                          suggestion(name.text(), names)));
  }
  // As deep as if it were written out here.
  enter(name, found->second.depth - 1, found->second.count);
  return found->second.shape;
}

namespace {

ShapePtr read_sphere(const Value& value) {
  const Fields fields(value, {"center", "radius"});
  return make_shape<Sphere>(value, fields.require("center").point(),
                            fields.require("radius").positive_length());
}

struct Axis {
  Vec3 from, to;
};

Axis read_axis(const Fields& fields) {
  const Value to = fields.require("to");
  const Axis axis{fields.require("from").point(), to.point()};
  if (axis.from == axis.to) to.fail("'to' must differ from 'from'");
  return axis;
}

ShapePtr read_cylinder(const Value& value) {
  const Fields fields(value, {"from", "to", "radius", "open"});
  const auto [from, to] = read_axis(fields);
  return make_shape<Cylinder>(value, from, to, fields.require("radius").positive_length(),
                              !read_flag(fields, "open"));
}

ShapePtr read_cone(const Value& value) {
  const Fields fields(value, {"from", "to", "radii", "open"});
  const auto [from, to] = read_axis(fields);
  const Value list = fields.require("radii");
  const std::vector<Value> radii = list.items(2, 2);
  const double first = radii[0].length(), second = radii[1].length();
  if (!(first >= 0 && second >= 0 && first + second > 0)) {
    list.fail("'radii' must not be negative, nor both 0: give the radius at each end");
  }
  return make_shape<Frustum>(value, from, to, first, second, !read_flag(fields, "open"));
}

ShapePtr read_disk(const Value& value) {
  const Fields fields(value, {"center", "normal", "radius", "inner_radius"});
  const std::optional<Value> inner = fields.find("inner_radius");
  return make_shape<Disk>(
      value, fields.require("center").point(), fields.require("normal").direction(),
      fields.require("radius").positive_length(), inner ? inner->positive_length() : 0.0);
}

ShapePtr read_torus(const Value& value) {
  const Fields fields(value, {"center", "axis", "major_radius", "minor_radius"});
  return make_shape<Torus>(value, fields.require("center").point(),
                           fields.require("axis").direction(),
                           fields.require("major_radius").positive_length(),
                           fields.require("minor_radius").positive_length());
}

ShapePtr read_blob(const Value& value) {
  const Fields fields(value, {"threshold", "balls"});
  std::vector<BlobBall> balls;
  for (const Value& item : fields.require("balls").items(1)) {
    const Fields ball(item, {"center", "radius", "strength"});
    const std::optional<Value> strength = ball.find("strength");
    balls.push_back({ball.require("center").point(), ball.require("radius").positive_length(),
                     strength ? strength->number() : 1});
  }
  return make_shape<Blob>(value, fields.require("threshold").number(), std::move(balls));
}

ShapePtr read_implicit(const Value& value) {
  const Fields fields(value, {"function", "lower", "upper"});
  const Value text = fields.require("function");
  std::optional<Expression> function;
  try {
    function.emplace(text.text());
  } catch (const InputError& error) {
    text.fail(error.what());
  }
  return make_shape<Implicit>(value, std::move(*function), fields.require("lower").point(),
                              fields.require("upper").point());
}

ShapePtr read_box(const Value& value) {
  const Fields fields(value, {"lower", "upper", "inward"});
  const ShapePtr box =
      make_shape<Box>(value, fields.require("lower").point(), fields.require("upper").point());
  return read_flag(fields, "inward") ? make_shape<Complement>(value, box) : box;
}

ShapePtr read_parallelogram(const Value& value) {
  const Fields fields(value, {"corner", "u", "v"});
  return make_shape<Parallelogram>(value, fields.require("corner").point(),
                                   fields.require("u").point(), fields.require("v").point());
}

ReadShape read_nested(const Value& value, ShapeNesting nesting);

/// A shape within that of the given key.
ShapePtr read_solid(const Value& value, std::string_view outer, ShapeNesting nesting) {
  const ReadShape read = read_nested(value, nesting);
  if (!read.shape->solid()) {
    value.fail(fmt::format("{} takes closed shapes only, and this {} is open", in_quotes(outer),
                           read.kind));
  }
  return read.shape;
}

/// The shapes that a CSG operation joins.
std::vector<ShapePtr> read_solids(const Value& value, ShapeNesting nesting) {
  std::vector<ShapePtr> solids;
  for (const Value& operand : value.items(2)) {
    solids.push_back(read_solid(operand, value.label(), nesting));
  }
  return solids;
}

template <CsgOperation operation>
ShapePtr read_csg(const Value& value, ShapeNesting nesting) {
  const std::vector<ShapePtr> solids = read_solids(value, nesting);
  try {
    return join(operation, solids);
  } catch (const InputError& error) {
    refuse_shape(value, error);
  }
}

ShapePtr read_complement(const Value& value, ShapeNesting nesting) {
  return make_shape<Complement>(value, read_solid(value, value.label(), nesting));
}

ShapePtr read_reversed(const Value& value, ShapeNesting nesting) {
  return make_shape<Reversed>(value, read_nested(value, nesting).shape);
}

ShapePtr read_instance(const Value& value, ShapeNesting nesting) { return nesting.named(value); }

/// A shape that holds no others.
template <ShapePtr (*read)(const Value&)>
ShapePtr plain(const Value& value, ShapeNesting /*nesting*/) {
  return read(value);
}

struct ShapeKind {
  std::string_view key;
  ShapePtr (*read)(const Value& value, ShapeNesting nesting);
};

constexpr ShapeKind kShapeKinds[] = {
    {"sphere", plain<read_sphere>},
    {"cylinder", plain<read_cylinder>},
    {"cone", plain<read_cone>},
    {"disk", plain<read_disk>},
    {"torus", plain<read_torus>},
    {"blob", plain<read_blob>},
    {"implicit", plain<read_implicit>},
    {"box", plain<read_box>},
    {"parallelogram", plain<read_parallelogram>},
    {"polygon", plain<read_polygon>},
    {"mesh", plain<read_mesh>},
    {"prism", plain<read_prism>},
    {"revolution", plain<read_revolution>},
    {"sweep", plain<read_sweep>},
    {"height_field", plain<read_height_field>},
    {"bezier", plain<read_bezier>},
    {"nurbs", plain<read_nurbs>},
    {"union", read_csg<CsgOperation::unite>},
    {"intersection", read_csg<CsgOperation::intersect>},
    {"difference", read_csg<CsgOperation::subtract>},
    {"complement", read_complement},
    {"reversed", read_reversed},
    {"instance", read_instance},
};

ReadShape read_nested(const Value& value, ShapeNesting nesting) {
  ++nesting.depth;
  nesting.enter(value, 0, 1);
  std::vector<std::string_view> known;
  for (const ShapeKind& kind : kShapeKinds) known.push_back(kind.key);
  known.insert(known.end(), {"transform", "material", "emission"});
  const Fields fields(value, known);
  nesting.read_finish(fields);
  ReadShape read;
  for (const auto& [key, inner] : value.entries()) {
    const std::string_view name = key.label();
    if (name == "transform" || name == "material" || name == "emission") continue;
    if (read.shape) {
      key.fail(
          fmt::format("{} is a second shape beside {}: an object has one, so make another "
                      "object or a union",
                      in_quotes(name), in_quotes(read.kind)));
    }
    const auto kind = std::find_if(std::begin(kShapeKinds), std::end(kShapeKinds),
                                   [&](const ShapeKind& k) { return k.key == name; });
    const std::size_t before = nesting.faces.size();
    read = {kind->key, kind->read(inner, nesting), {}};
    if (nesting.faces.size() == before) {  // it holds no others
      nesting.faces.push_back({read.shape->face_count(), nesting.finish});
    }
  }
  if (!read.shape) {
    known.resize(known.size() - 3);
    value.fail(fmt::format("no shape here: use one of {}", enumerated(known)));
  }
  read.shape = transformed(read.shape, fields);
  return read;
}

}  // namespace

void ShapeLibrary::add(const Value& name, const Value& shape) {
  Named named;
  std::vector<FaceRun> faces;
  named.shape = read_nested(shape, {*this, named.depth, named.count, faces, nullptr, {}}).shape;
  named_.emplace(name.text(), std::move(named));
}

ReadShape ShapeLibrary::read(const Value& value, const FindMaterial& find_material) const {
  int deepest = 0;
  std::size_t count = 0;
  std::vector<FaceRun> faces;
  ReadShape read = read_nested(value, {*this, deepest, count, faces, &find_material, {}});
  read.faces = std::move(faces);
  return read;
}

ShapePtr transformed(ShapePtr shape, const Fields& fields) {
  const std::optional<Value> steps = fields.find("transform");
  if (!steps) return shape;
  return make_shape<Instance>(*steps, std::move(shape), read_transform(*steps));
}

}  // namespace isolux
