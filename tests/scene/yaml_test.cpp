#include "isolux/scene/yaml.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "isolux/core/error.h"
#include "isolux/core/file.h"

namespace isolux {
namespace {

/// The tree with all places, in one line.
std::string shown(const YamlNode& node) {
  std::string text =
      fmt::format("{}@{}:{}*{}", node.quoted ? "q" : "", node.line, node.column, node.weight);
  switch (node.kind) {
    case YamlNode::Kind::null:
      return text + "null";
    case YamlNode::Kind::scalar:
      return text + '<' + std::string(node.text) + '>';
    case YamlNode::Kind::list:
      text += "list";
      break;
    case YamlNode::Kind::map:
      text += "map";
      break;
  }
  text += '(';
  for (const YamlNode* child : node.children) text += shown(*child);
  return text + ')';
}

/// Whether the text is plain; then it means the same to both parsers.
bool is_plain(const std::string& text) {
  const auto plain = parse_plain_yaml(text, "a.yaml");
  if (!plain) return false;
  EXPECT_EQ(shown(*plain->root), shown(*parse_full_yaml(text, "a.yaml").root)) << text;
  return true;
}

TEST(Yaml, PlainTextMeansTheSameToBothParsers) {
  for (const char* text : {
           "a: 1\n",
           "a: 1",
           "# first\n\na: 1 # last\n# end",
           "a: [1, -2.5e3, +x, .5]\nb: {c: d e, f: [g, {}], h: []}\n",
           "a:   two words   \n'b c': \"d: # e\"\n\"f\" : 'g'\n",
           "a:\n  b:\n      c: 1\n      d: 2\n  e: 3\nf: 4\n",
           "a:\n- b: 1\n  c: 2\n-   d: 3\n    e:\n    - 4\n    - [5]\nf: g\n",
           "a:\n  - 1\n  - \n    b: 2\n  -   # nothing\n    c: 3\n",
           "a:   # why\n  b: 1\n   # because\nc: 2\n",
           "name: Säule № 3\nit's: a 'b' \"c\" &d *e !f @g <h> 5 % = 6; | ~ (i) $j k^2\n",
           "a: b-c\n-d: 1\n.e: /f/g\n_: \" h \"\n",
           "a: {b : 1,c: [ 2 ,3 ]}\n",
       }) {
    EXPECT_TRUE(is_plain(text)) << text;
  }
}

TEST(Yaml, WhatIsNotPlainIsLeftToTheFullParser) {
  for (const char* text : {
           "",
           "a",
           "- a\n",
           " a: 1\n",
           "a:\n",
           "a: ~\n",
           "a: null\n",
           "a: b: c\n",
           "a: b:c\n",
           "a: b\n  c\n",
           "a:\n  b\n",
           "a: b\n c: d\n",
           "a: [1,\n  2]\n",
           "a: [1, 2,]\n",
           "a: [1,, 2]\n",
           "a: [b: 1]\n",
           "a: {b}\n",
           "a: {b: }\n",
           "a: {b:1}\n",
           "a: [1 2\n",
           "a: \"b\\n\"\n",
           "a: 'it''s'\n",
           "a: \"b\n  c\"\n",
           "a: |\n  b\n",
           "a: >\n  b\n",
           "a: &b c\n",
           "a: *b\n",
           "a: !b c\n",
           "? a\n: b\n",
           "a:\tb\n",
           "a: b\r\n",
           "--- \na: 1\n",
           "a: 1\n---\nb: 2\n",
           "a: 1\n...\n",
           "... : 1\n",
           "%YAML 1.2\n",
           "a: - b\n",
           "a:\n- - b\n",
           "a: b#c\n",
           "a: [b, c]d\n",
           "a: @b\n",
           "a: [b?]\n",
           "<<: {a: 1}\n",
           "a: \"b\" c\n",
           "a:\n  - b\n c: d\n",
           "a: # b",
           "\"a\"\n",
           "a: {b: 1} # c\n d: 1\n",
       }) {
    EXPECT_FALSE(is_plain(text)) << text;
  }
}

TEST(Yaml, ScenesOfTheProjectArePlainOrNot) {
  int plain = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ISOLUX_SOURCE_DIR)) {
    const bool is_ours = entry.path().string().find("/build/") == std::string::npos;
    if (entry.path().extension() != ".yaml" || !is_ours) continue;
    try {
      plain += is_plain(read_file(entry.path()));
    } catch (const InputError&) {  // one of those that are meant to be wrong
    }
  }
  EXPECT_GT(plain, 10);
}

TEST(Yaml, ManyValuesTakeLittleTime) {
  std::string text = "a:\n";
  for (int i = 0; i < 1'000'000; ++i) text += "  - [1, 2, 3]\n";
  const auto document = parse_plain_yaml(text, "a.yaml");
  ASSERT_TRUE(document);
  EXPECT_EQ(document->root->children[1]->children.size(), 1'000'000u);
  EXPECT_EQ(document->root->weight, 4'000'003u);
  EXPECT_THROW(parse_full_yaml(text, "a.yaml"), InputError);
}

}  // namespace
}  // namespace isolux
