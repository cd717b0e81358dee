#pragma once

#include <optional>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/core/vec3.h"
#include "isolux/formats/pbrt/lexer.h"

namespace isolux::pbrt {

/// One of the values that follow a directive: "float radius" [2].
struct Parameter {
  std::string_view type, name;
  std::vector<double> numbers;
  std::vector<std::string_view> texts;  ///< also true and false
  SourceLocation where;

  [[noreturn]] void fail(const std::string& message) const { throw InputError(where, message); }
};

/// Those of one directive. What is asked for and of another type is an error; what is not there is
/// nothing.
class Parameters {
 public:
  /// Reads all that follow.
  explicit Parameters(Lexer& lexer);

  const Parameter* find(std::string_view name) const;
  std::optional<double> number(std::string_view name) const;
  std::optional<Vec3> point(std::string_view name) const;
  std::vector<Vec3> points(std::string_view name) const;
  /// Whole numbers from 0 on, each less than `limit`.
  std::vector<std::uint32_t> indices(std::string_view name, std::size_t limit) const;
  std::string_view text(std::string_view name) const;  ///< empty where it is not there
  bool flag(std::string_view name) const;
  /// A number, "rgb" or "blackbody", not negative; nothing for other spectra and textures.
  std::optional<Rgb> color(std::string_view name) const;

 private:
  std::vector<Parameter> all_;
};

}  // namespace isolux::pbrt
