#pragma once

#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/formats/notes.h"
#include "isolux/formats/radiance/scanner.h"
#include "isolux/formats/radiance/skies.h"

namespace isolux::radiance {

/// What a surface has of its modifiers.
struct Finish {
  std::string name;   ///< of the material
  Rgb reflectance;    ///< at most kMostReflectance
  Rgb exitance;       ///< lm/m²
  bool solid = true;  ///< else light passes as if the surface were not there
};

/// Whether the type is that of a material, pattern, texture or mixture, or an alias.
bool is_modifier(std::string_view type);
/// The names of all such types.
std::vector<std::string_view> modifier_types();

/// The materials of a scene, as its modifiers make them.
class Materials {
 public:
  explicit Materials(Notes& notes);

  /// Takes a modifier, which from here on has its name. `map` is where what describes it stands.
  void define(const Primitive& primitive, const Affine& map);
  /// What the modifier of that name makes of a surface; notes what is lost by that.
  const Finish& finish_of(std::string_view modifier);
  /// What the modifier of that name makes of a source that is no sun.
  SourceLight source_light_of(std::string_view modifier);
  /// Notes the names that no modifier has, though others or surfaces refer to them.
  void note_undefined() const;

 private:
  /// A modifier: a material, or one that refers to another modifier.
  struct Modifier {
    std::string_view type;    ///< of a table that lives on
    std::size_t next = 0;     ///< the modifier behind this one
    std::size_t finish = 0;   ///< among finishes_
    std::string_view change;  ///< what becomes of it, empty where it is kept
    bool clamped = false;     ///< reflects more than there is
    bool noted = false;
    LightPattern own_pattern, pattern;  ///< of its light: its own, with those behind it
  };

  std::size_t find(std::string_view name) const;
  /// The same, remembering names that are not there.
  std::size_t require(std::string_view name);
  void define_material(const Primitive& primitive, Modifier& modifier);
  Modifier alias(const Primitive& primitive);
  void note(Modifier& modifier);

  Notes& notes_;
  std::vector<Finish> finishes_;
  std::vector<Modifier> modifiers_;
  std::unordered_map<std::string, std::size_t> numbers_;  ///< of those in force, by name
  std::set<std::string> undefined_;
};

}  // namespace isolux::radiance
