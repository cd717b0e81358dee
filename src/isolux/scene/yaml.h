#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace isolux {

/// A node of a YAML document, with its place (counted from 1).
struct YamlNode {
  enum class Kind : std::uint8_t { null, scalar, list, map };

  Kind kind = Kind::null;
  bool quoted = false;       ///< of a scalar: written in quotes or as a block
  std::uint32_t weight = 1;  ///< how many nodes it stands for, aliases written out
  int line = 0;
  int column = 0;
  std::string text;                       ///< of a scalar
  std::vector<const YamlNode*> children;  ///< of a map: key, value, key, value ...
};

/// A YAML document as a tree (a graph without cycles where it has aliases).
struct YamlDocument {
  std::string file;
  std::deque<YamlNode> nodes;
  const YamlNode* root = nullptr;
};

/// Parses YAML 1.2 text that holds one document, a map. Throws InputError with the place where the
/// text is empty, binary, not UTF-8, not YAML, has tags, a repeated key or more than one document,
/// or is deeper or (aliases written out) larger than a scene can be.
YamlDocument parse_yaml(const std::string& text, const std::string& file);

}  // namespace isolux
