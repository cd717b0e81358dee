#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "isolux/scene/reading_progress.h"

namespace isolux {

/// A node of a YAML document, with its place (counted from 1).
struct YamlNode {
  enum class Kind : std::uint8_t { null, scalar, list, map };

  Kind kind = Kind::null;
  bool quoted = false;       ///< of a scalar: written in quotes or as a block
  std::uint32_t weight = 1;  ///< how many nodes it stands for, aliases written out
  int line = 0;
  int column = 0;
  std::string_view text;                      ///< of a scalar
  std::span<const YamlNode* const> children;  ///< of a map: key, value, key, value ...
};

/// A YAML document as a tree (a graph without cycles where it has aliases).
struct YamlDocument {
  std::string file;
  std::deque<YamlNode> nodes;
  /// Texts and lists of children.
  std::unique_ptr<std::pmr::monotonic_buffer_resource> store =
      std::make_unique<std::pmr::monotonic_buffer_resource>();
  const YamlNode* root = nullptr;
};

/// Parses YAML 1.2 text that holds one document, a map. Throws InputError with the place where the
/// text is empty, binary, not UTF-8, not YAML, has tags, a repeated key or more than one document,
/// or is deeper or (aliases written out) larger than a scene can be.
YamlDocument parse_yaml(const std::string& text, const std::string& file,
                        const ReadingCallback& progress = {});

// What parse_yaml() chooses from.

/// The same by yaml-cpp, for texts up to 64 MiB of up to 4 million values.
YamlDocument parse_full_yaml(const std::string& text, const std::string& file,
                             const ReadingCallback& progress = {});

/// The same for texts of up to 12 million values, and much faster, where the text is plain (see
/// yaml_plain.h); nothing where it is not, or has no map at its top.
std::optional<YamlDocument> parse_plain_yaml(const std::string& text, const std::string& file,
                                             const ReadingCallback& progress = {});

}  // namespace isolux
