#include "isolux/scene/yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <sstream>
#include <string_view>

#include "isolux/core/error.h"
#include "isolux/scene/utf8.h"
#include "isolux/scene/yaml_plain.h"
#include "isolux/scene/yaml_tree.h"

namespace isolux {
namespace {

constexpr std::uint32_t kMostNodes = 4'000'000, kMostPlainNodes = 12'000'000;  ///< some 900 MB
constexpr std::size_t kLargestFullText = std::size_t{64} << 20;                ///< bytes

void check_is_text(std::string_view text, const std::string& file) {
  int line = 1;
  std::size_t line_start = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = utf8_length(text.substr(i));
    const auto c = static_cast<unsigned char>(text[i]);
    const bool control = (c < 0x20 && c != '\n' && c != '\r' && c != '\t') || c == 0x7f;
    if (size == 0 || control) {
      throw InputError({file, line, static_cast<int>(i - line_start) + 1},
                       fmt::format("byte 0x{:02x} is no UTF-8 text: is this a scene file? "
                                   "If so, save it as UTF-8",
                                   c));
    }
    if (c == '\n') {
      ++line;
      line_start = i + 1;
    }
    i += size;
  }
}

}  // namespace

YamlDocument parse_full_yaml(const std::string& text, const std::string& file,
                             const ReadingCallback& progress) {
  if (text.size() > kLargestFullText) {
    throw InputError({file},
                     "is larger than 64 MiB, and has YAML that takes long to read: write each "
                     "value in one line, without anchors, tabs, escapes and block texts");
  }
  YamlDocument document;
  document.file = file;
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    YamlTreeBuilder builder(document, {kMostNodes, text.size(), progress});
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw InputError({file, error.mark.line + 1, error.mark.column + 1},
                     fmt::format("not valid YAML ({}): check indentation, colons, quotes and "
                                 "brackets here and just before",
                                 error.msg));
  }
  return document;
}

std::optional<YamlDocument> parse_plain_yaml(const std::string& text, const std::string& file,
                                             const ReadingCallback& progress) {
  YamlDocument document;
  document.file = file;
  YamlTreeBuilder builder(document, {kMostPlainNodes, text.size(), progress});
  if (!parse_plain(text, builder)) return std::nullopt;
  return document;
}

YamlDocument parse_yaml(const std::string& text, const std::string& file,
                        const ReadingCallback& progress) {
  check_is_text(text, file);
  std::optional<YamlDocument> plain = parse_plain_yaml(text, file, progress);
  YamlDocument document = plain ? std::move(*plain) : parse_full_yaml(text, file, progress);
  if (!document.root) {
    throw InputError({file, 1, 1}, "the file is empty: a scene starts with 'isolux: 1'");
  }
  if (document.root->kind != YamlNode::Kind::map) {
    throw InputError({file, document.root->line, document.root->column},
                     "not a scene: its top level must be keys such as 'isolux: 1' and 'objects:'");
  }
  return document;
}

}  // namespace isolux
