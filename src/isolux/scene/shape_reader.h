#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "isolux/geometry/shape.h"
#include "isolux/scene/finish.h"
#include "isolux/scene/value.h"

namespace isolux {

/// A shape and the key it was written under, such as "sphere".
struct ReadShape {
  std::string_view kind;
  std::shared_ptr<const Shape> shape;
  std::vector<FaceRun> faces;  ///< all, by what its parts look like
};

/// The number of the material that a value names.
using FindMaterial = std::function<std::uint32_t(const Value& name)>;

/// The shapes of a scene that have names, to stand in several places.
class ShapeLibrary {
 public:
  /// Reads a shape that may be made of those that were added before.
  void add(const Value& name, const Value& shape);

  /// Reads a shape: a map of one shape key, and perhaps a `transform`. The shapes that it is made
  /// of may have a `material`, and then an `emission`.
  ReadShape read(const Value& value, const FindMaterial& find_material) const;

 private:
  friend struct ShapeNesting;
  struct Named {
    std::shared_ptr<const Shape> shape;
    int depth = 0;          ///< of shapes within shapes
    std::size_t count = 0;  ///< of shapes that it is made of, all written out
  };
  std::map<std::string, Named, std::less<>> named_;
};

/// The shape under the `transform` among the fields, if there is one.
std::shared_ptr<const Shape> transformed(std::shared_ptr<const Shape> shape, const Fields& fields);

}  // namespace isolux
