#pragma once

#include "isolux/formats/assembly.h"
#include "isolux/formats/gltf/document.h"
#include "isolux/formats/texture.h"

namespace isolux::gltf {

/// The looks of a document's materials.
class Materials {
 public:
  Materials(Document& document, Notes& notes) : document_(document), notes_(notes) {}

  /// That of the material which the primitive names, or glTF's default.
  const Look& of(const Json& primitive);

 private:
  Look read(const Json& material);
  /// The colour that a list of factors and a texture make together.
  Rgb color(const Json& owner, const char* factor, const char* texture, const Rgb& otherwise);
  Rgb mean(const Json& texture_info);
  void note_what_is_left_out(const Json& material);

  Document& document_;
  Notes& notes_;
  Textures textures_;
  std::map<std::size_t, Look> looks_;
  Look default_{"default", gray(1), {}, false};
};

}  // namespace isolux::gltf
