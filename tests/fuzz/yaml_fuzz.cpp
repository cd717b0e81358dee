#include <cstdlib>
#include <string_view>

#include "fuzz/fuzz.h"
#include "isolux/core/error.h"
#include "isolux/scene/yaml.h"

namespace isolux {
namespace {

bool same(const YamlNode& a, const YamlNode& b) {
  const bool alike = a.kind == b.kind && a.quoted == b.quoted && a.weight == b.weight &&
                     a.line == b.line && a.column == b.column && a.text == b.text;
  if (!alike || a.children.size() != b.children.size()) return false;
  for (std::size_t i = 0; i < a.children.size(); ++i) {
    if (!same(*a.children[i], *b.children[i])) return false;
  }
  return true;
}

}  // namespace
}  // namespace isolux

/// What is plain means the same to both parsers.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  isolux::expect_no_harm([&] {
    isolux::parse_yaml(text, "a.yaml");
    const auto plain = isolux::parse_plain_yaml(text, "a.yaml");
    if (!plain) return;
    try {
      if (isolux::same(*plain->root, *isolux::parse_full_yaml(text, "a.yaml").root)) return;
    } catch (const isolux::InputError&) {
    }
    std::abort();
  });
  return 0;
}
