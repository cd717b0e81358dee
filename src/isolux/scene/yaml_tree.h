#pragma once

#include <yaml-cpp/eventhandler.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "isolux/scene/yaml.h"

namespace isolux {

/// Builds the tree of a document from a parser's events, refusing what a scene can't have: throws
/// InputError with its place.
class YamlTreeBuilder final : public YAML::EventHandler {
 public:
  struct Bounds {
    std::uint32_t most;     ///< nodes, aliases written out
    std::size_t text_size;  ///< bytes, to tell how far it is
    const ReadingCallback& progress;
  };
  YamlTreeBuilder(YamlDocument& document, const Bounds& bounds)
      : document_(document), bounds_(bounds) {}

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;

 private:
  /// A list or map that is being filled; its children are the last ones in `children_`.
  struct Open {
    YamlNode* node;
    std::size_t first_child;
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const;
  void refuse_tag(const YAML::Mark& mark, const std::string& tag) const;
  void refuse_bad_keys() const;
  void count(const YAML::Mark& mark, std::uint32_t weight);
  void append(const YamlNode* node);
  YamlNode& add(const YAML::Mark& mark, YAML::anchor_t anchor, YamlNode::Kind kind);
  void open(const YAML::Mark& mark, YAML::anchor_t anchor, YamlNode::Kind kind);
  void close();

  YamlDocument& document_;
  Bounds bounds_;
  std::vector<Open> open_;  ///< from the root to the node that is being filled
  std::vector<const YamlNode*> children_;
  std::unordered_map<YAML::anchor_t, const YamlNode*> anchors_;
  std::uint32_t size_ = 0;
};

}  // namespace isolux
