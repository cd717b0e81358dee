#include "isolux/geometry/complement.h"

#include "isolux/core/error.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/shape_description.h"

namespace isolux {

Complement::Complement(std::shared_ptr<const Shape> shape) : Reversed(std::move(shape)) {
  if (!shape_->solid()) {
    throw InputError(
        "only a solid can be turned inside out; close the open surface (a cylinder by "
        "leaving out 'open: true', a mesh by filling its holes)");
  }
}

ShapeDescription Complement::describe() const {
  if (original(shape_).shape->part_count() == 1) {
    ShapeDescription inner = shape_->describe();
    if (inner.kind == "box" && !inner.flag("inward")) {
      inner.fields.push_back({"inward", true});
      return inner;
    }
  }
  return {"complement", {}, {shape_}, {}};
}

}  // namespace isolux
