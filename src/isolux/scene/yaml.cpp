#include "isolux/scene/yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <optional>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "isolux/core/error.h"
#include "isolux/scene/spelling.h"
#include "isolux/scene/utf8.h"

namespace isolux {
namespace {

constexpr std::uint32_t kMaxNodes = 4'000'000;  ///< some 400 MB
constexpr std::size_t kMaxDepth = 400;

SourceLocation place(const std::string& file, const YAML::Mark& mark) {
  return {file, mark.line + 1, mark.column + 1};
}

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

/// Builds the tree from the parser's events, refusing what a scene can't have.
class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(YamlDocument& document) : document_(document) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (document_.root) fail(mark, "a second YAML document starts here: keep one scene a file");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const YamlNode* key = awaits_value() ? open_.back()->children.back() : nullptr;
    YamlNode& node = add(mark, anchor, YamlNode::Kind::null);
    if (key) {
      // The parser gives a missing value the place of what comes next; that of its key helps more.
      node.line = key->line;
      node.column = key->column;
    }
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    if (tag != "!") refuse_tag(mark, tag);
    YamlNode& node = add(mark, anchor, YamlNode::Kind::scalar);
    node.text = value;
    node.quoted = tag == "!";
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    refuse_tag(mark, tag);
    open(mark, anchor, YamlNode::Kind::list);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    refuse_tag(mark, tag);
    open(mark, anchor, YamlNode::Kind::map);
  }
  void OnMapEnd() override {
    refuse_bad_keys(*open_.back());
    close();
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const YamlNode* target = anchors_.at(anchor);
    for (const YamlNode* node : open_) {
      if (node == target) fail(mark, "an alias can't stand inside what it names");
    }
    count(mark, target->weight);
    append(target);
  }

 private:
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const {
    throw InputError(place(document_.file, mark), message);
  }

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!") {
      fail(mark, fmt::format("the YAML tag {} has no place in a scene: remove it", in_quotes(tag)));
    }
  }

  void refuse_bad_keys(const YamlNode& map) const {
    std::unordered_map<std::string_view, int> lines;
    for (std::size_t i = 0; i < map.children.size(); i += 2) {
      const YamlNode& key = *map.children[i];
      const SourceLocation where{document_.file, key.line, key.column};
      if (key.kind != YamlNode::Kind::scalar) throw InputError(where, "a key must be a plain word");
      const auto [first, fresh] = lines.emplace(key.text, key.line);
      if (!fresh) {
        throw InputError(where, fmt::format("repeated key {}, first on line {}: remove one of them",
                                            in_quotes(key.text), first->second));
      }
    }
  }

  bool awaits_value() const {
    return !open_.empty() && open_.back()->kind == YamlNode::Kind::map &&
           open_.back()->children.size() % 2 == 1;
  }

  void count(const YAML::Mark& mark, std::uint32_t weight) {
    if (weight > kMaxNodes - size_) {
      fail(mark, fmt::format("more than {} values: a scene can't be that large", kMaxNodes));
    }
    size_ += weight;
  }

  void append(const YamlNode* node) {
    if (!open_.empty()) {
      open_.back()->children.push_back(node);
    } else {
      document_.root = node;
    }
  }

  YamlNode& add(const YAML::Mark& mark, YAML::anchor_t anchor, YamlNode::Kind kind) {
    count(mark, 1);
    YamlNode& node = document_.nodes.emplace_back();
    node.kind = kind;
    node.line = mark.line + 1;
    node.column = mark.column + 1;
    append(&node);
    if (anchor != 0) anchors_[anchor] = &node;
    return node;
  }

  void open(const YAML::Mark& mark, YAML::anchor_t anchor, YamlNode::Kind kind) {
    if (open_.size() >= kMaxDepth) {
      fail(mark, fmt::format("nested more than {} levels deep: flatten the scene", kMaxDepth));
    }
    open_.push_back(&add(mark, anchor, kind));
  }

  void close() {
    YamlNode& node = *open_.back();
    for (const YamlNode* child : node.children) node.weight += child->weight;
    open_.pop_back();
  }

  YamlDocument& document_;
  std::vector<YamlNode*> open_;  ///< from the root to the node that is being filled
  std::unordered_map<YAML::anchor_t, const YamlNode*> anchors_;
  std::uint32_t size_ = 0;
};

}  // namespace

YamlDocument parse_yaml(const std::string& text, const std::string& file) {
  check_is_text(text, file);
  YamlDocument document;
  document.file = file;
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    TreeBuilder builder(document);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw InputError(place(file, error.mark),
                     fmt::format("not valid YAML ({}): check indentation, colons, quotes and "
                                 "brackets here and just before",
                                 error.msg));
  }
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
