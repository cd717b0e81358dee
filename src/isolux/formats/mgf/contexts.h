#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <compare>
#include <string>
#include <unordered_map>
#include <vector>

#include "isolux/core/vec3.h"
#include "isolux/formats/statement.h"
#include "isolux/scene/spelling.h"

namespace isolux::mgf {

struct Vertex {
  Vec3 point;
  Vec3 normal;  ///< of any length; zero: that of the surface
};

/// Hue and saturation: CIE X and Z where Y = 1.
struct Color {
  double x = 1, z = 1;

  Vec3 xyz() const { return {x, 1, z}; }
  auto operator<=>(const Color&) const = default;
};

struct Material {
  int sides = 2;
  double diffuse = 0;  ///< rd
  Color diffuse_color;
  double emittance = 0;  ///< ed, lm/m²
  Color emittance_color;
  double specular = 0;              ///< rs
  double diffuse_transmitted = 0;   ///< td
  double specular_transmitted = 0;  ///< ts
  bool refracts = false;            ///< ir

  auto operator<=>(const Material&) const = default;
};

/// The contexts of one kind: those with a name, and the one that entities now act on.
template <typename T>
class Contexts {
 public:
  /// Acts on "v", "v id", "v id =" or "v id = template".
  void select(const Statement& s);

  T& current() { return *current_; }
  const std::string& current_name() const { return current_name_; }
  /// The context that word i names, which must be defined.
  const T& named(const Statement& s, std::size_t i) const;

 private:
  std::unordered_map<std::string, T> named_;
  T unnamed_;
  T* current_ = &unnamed_;
  std::string current_name_;
};

template <typename T>
void Contexts<T>::select(const Statement& s) {
  s.expect_arguments(0, 3, "at most a name, = and a template");
  if (s.size() == 1) {
    unnamed_ = {};
    current_ = &unnamed_;
    current_name_.clear();
    return;
  }
  const std::string name(s.word(1));
  if (s.size() == 2) {
    named(s, 1);
  } else if (s.word(2) != "=") {
    s.fail(2, fmt::format("expected '=', not {}", in_quotes(s.word(2))));
  } else {
    const T values = s.size() == 4 ? named(s, 3) : T{};
    named_[name] = values;
  }
  current_name_ = name;
  current_ = &named_[name];
}

template <typename T>
const T& Contexts<T>::named(const Statement& s, std::size_t i) const {
  const auto found = named_.find(std::string(s.word(i)));
  if (found != named_.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& [name, value] : named_) names.push_back(name);
  std::sort(names.begin(), names.end());
  s.fail(i,
         fmt::format("{} is not defined: {}", in_quotes(s.word(i)), suggestion(s.word(i), names)));
}

}  // namespace isolux::mgf
