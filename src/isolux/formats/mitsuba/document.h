#pragma once

#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/core/error.h"
#include "isolux/formats/include_path.h"

namespace pugi {
class xml_node;
}

namespace isolux::mitsuba {

struct Attribute {
  std::string name, value;
};

/// An element of a file, with all that is in it.
struct Element {
  std::string tag;
  const std::string* file = nullptr;
  int line = 0, column = 0;
  std::vector<Attribute> attributes;
  std::vector<Element> children;

  /// The value of an attribute; null where it is not there.
  const std::string* find(std::string_view attribute) const;
  /// The same; an error where it is not there.
  const std::string& need(std::string_view attribute) const;
  /// The same; empty where it is not there.
  std::string_view text(std::string_view attribute) const;
  bool is(std::string_view what) const { return tag == what; }
  [[noreturn]] void fail(const std::string& message) const;
};

/// Makes something; what it throws without a place gets that of the element. For work that reads
/// no elements.
template <typename Make>
auto made_at(const Element& element, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    element.fail(error.what());
  }
}

/// A scene's files as one tree: what they include stands where they include it, `$name` has become
/// the parameter's value, and names of version 0 are written as later ones are.
class Document {
 public:
  /// Throws InputError with file, line and column at the first thing that is wrong.
  Document(const SourceText& source, Includes& includes);

  const Element& root() const { return root_; }
  /// The element that a <ref> means.
  const Element& target(const Element& ref) const;
  /// The same element, or the one it means where it is a <ref>.
  const Element& resolved(const Element& element) const {
    return element.is("ref") ? target(element) : element;
  }

 private:
  class File;
  void read(const SourceText& source, Includes& includes, Element& parent, int depth);
  Element element_of(File& file, const pugi::xml_node& node);
  void add_children(File& file, const pugi::xml_node& node, Includes& includes, Element& to,
                    int depth);
  void note_ids(const Element& element);
  void set_default(const Element& element);
  std::string substituted(const Element& element, std::string_view value);

  std::deque<std::string> files_;
  std::map<std::string, std::string, std::less<>> parameters_;
  std::map<std::string, const Element*, std::less<>> ids_;
  std::size_t items_ = 0;    ///< elements and attributes, of all files
  std::size_t letters_ = 0;  ///< of values that parameters are put into
  Element root_;
};

}  // namespace isolux::mitsuba
