#include "isolux/scene/yaml_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/mark.h>

#include <algorithm>
#include <string_view>

#include "isolux/core/error.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

constexpr std::size_t kMaxDepth = 400;
constexpr std::uint32_t kReportEvery = 1 << 14;  ///< nodes

/// A copy that lives as long as the document.
template <typename Item>
std::span<const Item> kept(YamlDocument& document, std::span<const Item> items) {
  if (items.empty()) return {};
  auto* const copy =
      static_cast<Item*>(document.store->allocate(items.size_bytes(), alignof(Item)));
  std::copy(items.begin(), items.end(), copy);
  return {copy, items.size()};
}

}  // namespace

void YamlTreeBuilder::fail(const YAML::Mark& mark, const std::string& message) const {
  throw InputError({document_.file, mark.line + 1, mark.column + 1}, message);
}

void YamlTreeBuilder::OnDocumentStart(const YAML::Mark& mark) {
  if (document_.root) fail(mark, "a second YAML document starts here: keep one scene a file");
}

void YamlTreeBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const bool is_value = !open_.empty() && open_.back().node->kind == YamlNode::Kind::map &&
                        (children_.size() - open_.back().first_child) % 2 == 1;
  const YamlNode* const key = is_value ? children_.back() : nullptr;
  YamlNode& node = add(mark, anchor, YamlNode::Kind::null);
  if (key) {
    // The parser gives a missing value the place of what comes next; that of its key helps more.
    node.line = key->line;
    node.column = key->column;
  }
}

void YamlTreeBuilder::OnScalar(const YAML::Mark& mark, const std::string& tag,
                               YAML::anchor_t anchor, const std::string& value) {
  if (tag != "!") refuse_tag(mark, tag);
  YamlNode& node = add(mark, anchor, YamlNode::Kind::scalar);
  const std::span<const char> text = kept<char>(document_, value);
  node.text = {text.data(), text.size()};
  node.quoted = tag == "!";
}

void YamlTreeBuilder::OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                                      YAML::anchor_t anchor, YAML::EmitterStyle::value /*style*/) {
  refuse_tag(mark, tag);
  open(mark, anchor, YamlNode::Kind::list);
}

void YamlTreeBuilder::OnMapStart(const YAML::Mark& mark, const std::string& tag,
                                 YAML::anchor_t anchor, YAML::EmitterStyle::value /*style*/) {
  refuse_tag(mark, tag);
  open(mark, anchor, YamlNode::Kind::map);
}

void YamlTreeBuilder::OnMapEnd() {
  refuse_bad_keys();
  close();
}

void YamlTreeBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const YamlNode* const target = anchors_.at(anchor);
  for (const Open& around : open_) {
    if (around.node == target) fail(mark, "an alias can't stand inside what it names");
  }
  count(mark, target->weight);
  append(target);
}

void YamlTreeBuilder::refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
  if (!tag.empty() && tag != "?" && tag != "!") {
    fail(mark, fmt::format("the YAML tag {} has no place in a scene: remove it", in_quotes(tag)));
  }
}

/// Looks at the keys of the innermost map.
void YamlTreeBuilder::refuse_bad_keys() const {
  constexpr std::size_t kFew = 16;  // compared one by one
  const std::size_t first = open_.back().first_child;
  const bool few = children_.size() - first <= 2 * kFew;
  std::unordered_map<std::string_view, int> lines;
  for (std::size_t i = first; i < children_.size(); i += 2) {
    const YamlNode& key = *children_[i];
    const SourceLocation where{document_.file, key.line, key.column};
    if (key.kind != YamlNode::Kind::scalar) throw InputError(where, "a key must be a plain word");
    int line = 0;  // of the same key before
    for (std::size_t k = first; few && k < i && line == 0; k += 2) {
      if (children_[k]->text == key.text) line = children_[k]->line;
    }
    if (!few) {
      const auto [known, fresh] = lines.emplace(key.text, key.line);
      if (!fresh) line = known->second;
    }
    if (line > 0) {
      throw InputError(where, fmt::format("repeated key {}, first on line {}: remove one of them",
                                          in_quotes(key.text), line));
    }
  }
}

void YamlTreeBuilder::count(const YAML::Mark& mark, std::uint32_t weight) {
  if (weight > bounds_.most - size_) {
    fail(mark, fmt::format("more than {} values: a scene can't be that large", bounds_.most));
  }
  size_ += weight;
}

void YamlTreeBuilder::append(const YamlNode* node) {
  if (!open_.empty()) {
    children_.push_back(node);
  } else {
    document_.root = node;
  }
}

YamlNode& YamlTreeBuilder::add(const YAML::Mark& mark, YAML::anchor_t anchor, YamlNode::Kind kind) {
  count(mark, 1);
  if (size_ % kReportEvery == 0) {
    report_progress(bounds_.progress, {"parsing", double(mark.pos) / double(bounds_.text_size)});
  }
  YamlNode& node = document_.nodes.emplace_back();
  node.kind = kind;
  node.line = mark.line + 1;
  node.column = mark.column + 1;
  append(&node);
  if (anchor != 0) anchors_[anchor] = &node;
  return node;
}

void YamlTreeBuilder::open(const YAML::Mark& mark, YAML::anchor_t anchor, YamlNode::Kind kind) {
  if (open_.size() >= kMaxDepth) {
    fail(mark, fmt::format("nested more than {} levels deep: flatten the scene", kMaxDepth));
  }
  YamlNode& node = add(mark, anchor, kind);
  open_.push_back({&node, children_.size()});
}

void YamlTreeBuilder::close() {
  const auto [node, first] = open_.back();
  node->children = kept<const YamlNode*>(document_, std::span(children_).subspan(first));
  for (const YamlNode* child : node->children) node->weight += child->weight;
  children_.resize(first);
  open_.pop_back();
}

}  // namespace isolux
