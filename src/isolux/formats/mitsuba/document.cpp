#include "isolux/formats/mitsuba/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <pugixml.hpp>

#include "isolux/scene/spelling.h"

namespace isolux::mitsuba {
namespace {

constexpr std::size_t kMostItems = 1'000'000;
constexpr std::size_t kMostLetters = std::size_t{16} << 20;
constexpr int kDeepest = 64;
constexpr std::size_t kLongestName = 64;  // of a parameter

const std::vector<std::string_view> kTags = {
    "alias",      "boolean", "bsdf",       "default",   "emitter",  "film",   "float",
    "include",    "integer", "integrator", "lookat",    "matrix",   "medium", "path",
    "phase",      "point",   "ref",        "rfilter",   "rgb",      "rotate", "sampler",
    "scale",      "scene",   "sensor",     "shape",     "spectrum", "srgb",   "string",
    "subsurface", "texture", "transform",  "translate", "vector",   "volume"};

/// toWorld, as version 0 has it, becomes to_world.
std::string snake_case(std::string_view name) {
  std::string result;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isupper(letter) && !result.empty()) result += '_';
    result += static_cast<char>(std::tolower(letter));
  }
  return result;
}

}  // namespace

const std::string* Element::find(std::string_view attribute) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const Attribute& a) { return a.name == attribute; });
  return found == attributes.end() ? nullptr : &found->value;
}

const std::string& Element::need(std::string_view attribute) const {
  const std::string* const value = find(attribute);
  if (!value) fail(fmt::format("<{}> needs {}=\"...\"", tag, attribute));
  return *value;
}

std::string_view Element::text(std::string_view attribute) const {
  const std::string* const value = find(attribute);
  return value ? std::string_view(*value) : std::string_view();
}

void Element::fail(const std::string& message) const {
  throw InputError({*file, line, column}, message);
}

/// A file as pugixml parses it, which knows the place of each element. Entities are not expanded.
class Document::File {
 public:
  const std::string& name;
  bool old = false;  ///< of version 0

  File(const SourceText& source, const std::string& its_name)
      : name(its_name), source_(source), bytes_(source.text) {
    const std::size_t zero = source.text.find('\0');
    if (zero != std::string::npos) fail(zero, "a byte of 0 in a text");
    const auto result = xml_.load_buffer_inplace(bytes_.data(), bytes_.size(), pugi::parse_default,
                                                 pugi::encoding_utf8);
    if (result.status == pugi::status_no_document_element) fail(0, "there is no <scene>");
    if (!result) {
      fail(static_cast<std::size_t>(result.offset),
           fmt::format("malformed XML: {}", result.description()));
    }
  }

  pugi::xml_node root() const { return xml_.document_element(); }
  /// Gives the element the place of the node; nodes come in the order of the file.
  void place(Element& element, const pugi::xml_node& node) {
    auto offset = static_cast<std::size_t>(node.offset_debug());
    if (node.type() == pugi::node_element) {
      --offset;  // from the name to the bracket
    } else {
      offset += std::string_view(node.value()).find_first_not_of(" \t\r\n");
    }
    move_to(offset);
    element.line = line_;
    element.column = static_cast<int>(offset - line_start_) + 1;
  }

 private:
  void move_to(std::size_t offset) {
    for (; at_ < std::min(offset, source_.text.size()); ++at_) {
      if (source_.text[at_] != '\n') continue;
      ++line_;
      line_start_ = at_ + 1;
    }
  }
  [[noreturn]] void fail(std::size_t offset, const std::string& message) {
    move_to(offset);
    throw InputError({source_.file, line_, static_cast<int>(offset - line_start_) + 1}, message);
  }

  const SourceText& source_;
  std::string bytes_;  ///< which pugixml writes into
  pugi::xml_document xml_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

Document::Document(const SourceText& source, Includes& includes) {
  read(source, includes, root_, 0);
  note_ids(root_);
}

void Document::read(const SourceText& source, Includes& includes, Element& parent, int depth) {
  const std::string& text = source.text;
  // As many as there can be at most: an element takes three bytes, but a hundred in memory.
  items_ += static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return c == '<' || c == '='; }));
  if (items_ > kMostItems) {
    throw InputError({source.file}, fmt::format("more than {} elements and attributes: keep "
                                                "meshes in files of their own",
                                                kMostItems));
  }
  files_.push_back(source.file);
  File file(source, files_.back());
  Element scene = element_of(file, file.root());
  if (!scene.is("scene")) {
    scene.fail(fmt::format("expected <scene>, not <{}>: no scene of Mitsuba", scene.tag));
  }
  file.old = scene.text("version").starts_with("0.");
  if (depth == 0) parent = std::move(scene);
  add_children(file, file.root(), includes, parent, depth + 1);
}

/// The element without its children.
Element Document::element_of(File& file, const pugi::xml_node& node) {
  Element element;
  element.file = &file.name;
  file.place(element, node);
  if (node.type() != pugi::node_element) {
    element.fail(fmt::format("unexpected text {}", in_quotes(node.value())));
  }
  element.tag = file.old ? snake_case(node.name()) : node.name();
  if (element.tag == "look_at") element.tag = "lookat";
  const bool known = std::find(kTags.begin(), kTags.end(), element.tag) != kTags.end();
  if (!known && node != file.root()) {
    element.fail(fmt::format("there is no element {}: {}", in_quotes(element.tag),
                             suggestion(element.tag, kTags)));
  }
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    std::string value = substituted(element, attribute.value());
    const bool is_name = std::string_view(attribute.name()) == "name";
    if (file.old && is_name) value = snake_case(value);
    element.attributes.push_back({attribute.name(), std::move(value)});
  }
  return element;
}

void Document::add_children(File& file, const pugi::xml_node& node, Includes& includes, Element& to,
                            int depth) {
  for (const pugi::xml_node& child : node.children()) {
    Element element = element_of(file, child);
    if (depth > kDeepest) element.fail("elements nest too deep");
    if (element.is("scene")) element.fail("<scene> must be the outermost element");
    if (element.is("include")) {
      const std::string& path = element.need("filename");
      const SourceText included = made_at(element, [&] { return includes.open(path); });
      read(included, includes, to, depth);
      includes.close();
      continue;
    }
    add_children(file, child, includes, element, depth + 1);
    if (element.is("default")) set_default(element);
    to.children.push_back(std::move(element));
  }
}

void Document::set_default(const Element& element) {
  parameters_.try_emplace(element.need("name"), element.need("value"));
}

/// The value with parameters in place of `$name`, the longest name that there is.
std::string Document::substituted(const Element& element, std::string_view value) {
  std::string result;
  for (std::size_t dollar; (dollar = value.find('$')) != value.npos;) {
    result += value.substr(0, dollar);
    value.remove_prefix(dollar + 1);
    const auto is_part = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    };
    std::size_t length = 0;
    while (length < std::min(value.size(), kLongestName) && is_part(value[length])) ++length;
    const std::string_view word = value.substr(0, length);
    auto found = parameters_.end();
    for (; length > 0 && found == parameters_.end(); --length) {
      found = parameters_.find(value.substr(0, length));
    }
    if (found == parameters_.end()) {
      std::vector<std::string_view> names;
      for (const auto& [name, text] : parameters_) names.push_back(name);
      element.fail(
          fmt::format("there is no parameter {}: {}", in_quotes(word), suggestion(word, names)));
    }
    result += found->second;
    value.remove_prefix(found->first.size());
    letters_ += found->second.size();
    if (letters_ > kMostLetters) element.fail("parameters grow too long");
  }
  return result += value;
}

void Document::note_ids(const Element& element) {
  if (element.is("alias")) {
    // For something that came before it.
    const auto found = ids_.find(element.need("id"));
    if (found == ids_.end()) {
      element.fail(
          fmt::format("there is nothing with id {} before", in_quotes(element.need("id"))));
    }
    const Element* const meant = found->second;
    if (!ids_.emplace(element.need("as"), meant).second) {
      element.fail(fmt::format("the id {} comes twice", in_quotes(element.need("as"))));
    }
  } else if (const std::string* const id = element.find("id"); id && !element.is("ref")) {
    if (!ids_.emplace(*id, &element).second) {
      element.fail(fmt::format("the id {} comes twice", in_quotes(*id)));
    }
  }
  for (const Element& child : element.children) note_ids(child);
}

const Element& Document::target(const Element& ref) const {
  const auto found = ids_.find(ref.need("id"));
  if (found != ids_.end()) return *found->second;
  std::vector<std::string_view> names;
  for (const auto& [id, element] : ids_) names.push_back(id);
  ref.fail(fmt::format("there is nothing with id {}: {}", in_quotes(ref.need("id")),
                       suggestion(ref.need("id"), names)));
}

}  // namespace isolux::mitsuba
