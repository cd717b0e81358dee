#pragma once

#include <filesystem>

#include "isolux/formats/gltf/json.h"
#include "isolux/formats/include_path.h"

namespace isolux::gltf {

/// A glTF file with its buffers (Khronos, glTF 2.0 Specification, §3.6). Whatever leaves its buffer
/// or list ends in an InputError.
class Document {
 public:
  /// Reads a .gltf or .glb file. Buffers and images lie within it, or in the folder of `path` or
  /// below.
  explicit Document(const std::filesystem::path& path);

  Json root() const { return {file_, tree_, ""}; }
  /// Item `index` of a list of the root, such as nodes; `index` names it where it is not there.
  Json item(const char* list, const Json& index) const;
  /// The number that `index` has in that list.
  std::size_t number(const char* list, const Json& index) const;
  std::size_t count(const char* list) const;

  /// The elements of an accessor, `components` numbers each (as floats where they are normalized),
  /// sparse ones put in.
  std::vector<double> numbers(const Json& accessor_index, std::size_t components);
  /// Those of an accessor of indices, each less than `limit`.
  std::vector<std::uint32_t> indices(const Json& accessor_index, std::size_t limit);
  /// An image as a file; empty where it can't be read.
  std::string image(const Json& image);

 private:
  std::string_view buffer(const Json& index);
  std::string_view view(const Json& index, std::size_t& stride);
  std::string resource(const Json& uri);
  std::vector<double> read(const Json& owner, const char* view_key, std::size_t offset, int type,
                           std::size_t components, std::size_t count, bool normalized);

  std::string file_;
  nlohmann::json tree_;
  std::string binary_;  ///< the second chunk of a .glb
  Includes includes_;
  std::vector<std::optional<std::string>> buffers_;  ///< read so far
  std::size_t numbers_read_ = 0;
};

}  // namespace isolux::gltf
