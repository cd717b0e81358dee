#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/core/vec3.h"

namespace isolux::gltf {

/// One value of a JSON text, read strictly: whatever is not as asked for ends in an InputError that
/// names the file and the value's path, such as nodes[3].mesh. It refers to the text's tree.
class Json {
 public:
  Json(const std::string& file, const nlohmann::json& value, std::string path)
      : file_(&file), value_(&value), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& message) const;

  bool is_object() const { return value_->is_object(); }
  std::optional<Json> find(const char* key) const;  ///< a member of this object
  Json require(const char* key) const;
  std::size_t size() const;  ///< of this list
  Json item(std::size_t i) const;

  double number() const;
  std::vector<double> numbers(std::size_t count) const;  ///< a list of that many
  Vec3 vector() const;
  /// A whole number from 0 to `most`.
  std::uint64_t integer(std::uint64_t most) const;
  const std::string& text() const;

  // Members that may be left out.
  double number(const char* key, double otherwise) const;
  std::uint64_t integer(const char* key, std::uint64_t most, std::uint64_t otherwise) const;
  std::string text(const char* key) const;  ///< empty where it is left out
  bool flag(const char* key) const;         ///< false where it is left out
  /// The extension of that name.
  std::optional<Json> extension(const char* name) const;

 private:
  const std::string* file_;
  const nlohmann::json* value_;
  std::string path_;
};

/// Parses a text of at most 2 million values, 64 deep. Throws InputError with line and column,
/// counted from the beginning of `text`.
nlohmann::json parse_json(std::string_view text, const std::string& file);

}  // namespace isolux::gltf
