#include "isolux/formats/mesh/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "isolux/core/error.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/statement_reader.h"
#include "isolux/scene/length.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kMostFaces = 2'000'000;

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count;  ///< of a list: the type of its length
};

struct Element {
  std::string name;
  std::size_t count;
  std::vector<Property> properties;
};

enum class Format { text, little, big };

struct Header {
  Format format = Format::text;
  std::vector<Element> elements;
  std::size_t size = 0;  ///< bytes
  int lines = 0;
};

Type read_type(const Statement& s, std::size_t i) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames = {{{"char", "int8"},
                                                                      {"uchar", "uint8"},
                                                                      {"short", "int16"},
                                                                      {"ushort", "uint16"},
                                                                      {"int", "int32"},
                                                                      {"uint", "uint32"},
                                                                      {"float", "float32"},
                                                                      {"double", "float64"}}};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    if (s.word(i) == kNames[k][0] || s.word(i) == kNames[k][1]) return static_cast<Type>(k);
  }
  s.fail(i, fmt::format("there is no type {}", in_quotes(s.word(i))));
}

void read_header_line(const Statement& s, Header& header) {
  const std::string_view word = s.word(0);
  if (word == "format") {
    s.expect_arguments(2, 2, "format ascii 1.0");
    constexpr std::array<std::string_view, 3> kFormats = {"ascii", "binary_little_endian",
                                                          "binary_big_endian"};
    const auto found = std::find(kFormats.begin(), kFormats.end(), s.word(1));
    if (found == kFormats.end()) {
      s.fail(1, fmt::format("there is no format {}", in_quotes(s.word(1))));
    }
    header.format = static_cast<Format>(found - kFormats.begin());
  } else if (word == "element") {
    s.expect_arguments(2, 2, "element name count");
    const int count = s.integer(2, 0, std::numeric_limits<int>::max());
    header.elements.push_back({std::string(s.word(1)), static_cast<std::size_t>(count), {}});
  } else if (word == "property") {
    if (header.elements.empty()) s.fail(0, "this property has no element before it");
    auto& properties = header.elements.back().properties;
    if (s.size() > 1 && s.word(1) == "list") {
      s.expect_arguments(4, 4, "property list count_type type name");
      properties.push_back({std::string(s.word(4)), read_type(s, 3), read_type(s, 2)});
    } else {
      s.expect_arguments(2, 2, "property type name");
      properties.push_back({std::string(s.word(2)), read_type(s, 1), {}});
    }
  } else if (word != "comment" && word != "obj_info") {
    s.fail(0, fmt::format("{} is no word of a PLY header", in_quotes(word)));
  }
}

Header read_header(const SourceText& source) {
  constexpr std::string_view kEnd = "end_header";
  const std::size_t end = source.text.find(kEnd);
  const std::size_t line_end = source.text.find('\n', end);
  if (end == std::string::npos || line_end == std::string::npos) {
    throw InputError({source.file, 1, 1}, "the header does not end: it needs end_header");
  }
  Header header;
  header.size = line_end + 1;
  const SourceText text{source.file, source.text.substr(0, end)};
  header.lines = static_cast<int>(std::count(text.text.begin(), text.text.end(), '\n')) + 1;
  StatementReader statements(text);
  const auto first = statements.next();
  if (!first || first->word(0) != "ply") {
    throw InputError({source.file, 1, 1}, "a PLY file begins with the word ply");
  }
  while (const auto s = statements.next()) read_header_line(*s, header);
  return header;
}

/// The numbers behind a header, one after the other.
class Numbers {
 public:
  Numbers(const SourceText& source, const Header& header)
      : source_(source),
        format_(header.format),
        at_(header.size),
        line_start_(header.size),
        line_(header.lines + 1) {}

  double next(Type type) { return format_ == Format::text ? next_word() : next_bytes(type); }
  [[noreturn]] void fail(const std::string& message) const {
    if (format_ != Format::text) throw InputError({source_.file}, message);
    throw InputError({source_.file, line_, static_cast<int>(word_ - line_start_) + 1}, message);
  }
  std::size_t bytes_left() const { return source_.text.size() - at_; }

 private:
  double next_word();
  double next_bytes(Type type);

  const SourceText& source_;
  Format format_;
  std::size_t at_, line_start_;
  std::size_t word_ = 0;  ///< where the last one began
  int line_;
};

double Numbers::next_word() {
  const std::string& text = source_.text;
  const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
  for (; at_ < text.size() && is_blank(text[at_]); ++at_) {
    if (text[at_] != '\n') continue;
    ++line_;
    line_start_ = at_ + 1;
  }
  word_ = at_;
  while (at_ < text.size() && !is_blank(text[at_])) ++at_;
  if (word_ == at_) fail("the file ends too early");
  const std::string_view word = std::string_view(text).substr(word_, at_ - word_);
  const auto number = parse_number(word);
  if (!number || !std::isfinite(*number)) {
    fail(fmt::format("expected a finite number, not {}", in_quotes(word)));
  }
  return *number;
}

template <typename Number>
double decoded(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

double Numbers::next_bytes(Type type) {
  const std::size_t size = size_of(type);
  if (size > bytes_left()) fail("the file ends too early");
  std::array<char, 8> bytes{};
  std::copy_n(source_.text.begin() + static_cast<std::ptrdiff_t>(at_), size, bytes.begin());
  if (format_ == Format::big) std::reverse(bytes.begin(), bytes.begin() + size);
  at_ += size;
  switch (type) {
    case Type::int8:
      return decoded<std::int8_t>(bytes.data());
    case Type::uint8:
      return decoded<std::uint8_t>(bytes.data());
    case Type::int16:
      return decoded<std::int16_t>(bytes.data());
    case Type::uint16:
      return decoded<std::uint16_t>(bytes.data());
    case Type::int32:
      return decoded<std::int32_t>(bytes.data());
    case Type::uint32:
      return decoded<std::uint32_t>(bytes.data());
    case Type::float32:
      return decoded<float>(bytes.data());
    default:
      return decoded<double>(bytes.data());
  }
}

std::vector<double> read_list(Numbers& numbers, const Property& property) {
  if (!property.count) return {numbers.next(property.type)};
  const double count = numbers.next(*property.count);
  if (!(count >= 0 && count <= static_cast<double>(numbers.bytes_left())) ||
      count != std::floor(count)) {
    numbers.fail(fmt::format("a list can't have {} items", count));
  }
  std::vector<double> list(static_cast<std::size_t>(count));
  for (double& item : list) item = numbers.next(property.type);
  return list;
}

void read_vertex(Numbers& numbers, const Element& element, TriangleSoup& soup) {
  Vec3 point;
  for (const Property& property : element.properties) {
    const std::vector<double> value = read_list(numbers, property);
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (property.name.size() != 1 || axis == std::string_view::npos || value.empty()) continue;
    if (!(std::abs(value[0]) <= kFarthest)) {
      numbers.fail(fmt::format("vertex {0} must lie between -{1:g} and {1:g}", soup.points.size(),
                               kFarthest));
    }
    point[static_cast<int>(axis)] = value[0];
  }
  soup.points.push_back(point);
}

void read_face(Numbers& numbers, const Element& element, std::vector<std::vector<double>>& faces) {
  for (const Property& property : element.properties) {
    std::vector<double> list = read_list(numbers, property);
    if (property.name == "vertex_indices" || property.name == "vertex_index") {
      if (faces.size() == kMostFaces) numbers.fail("the file has too many faces");
      faces.push_back(std::move(list));
    }
  }
}

}  // namespace

TriangleSoup parse_ply(const SourceText& source, Cutting& cutting) {
  const Header header = read_header(source);
  Numbers numbers(source, header);
  TriangleSoup soup;
  std::vector<std::vector<double>> faces;
  for (const Element& element : header.elements) {
    for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      if (element.name == "vertex") {
        read_vertex(numbers, element, soup);
      } else {
        std::vector<std::vector<double>> others;
        read_face(numbers, element, element.name == "face" ? faces : others);
      }
    }
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::vector<std::uint32_t> corners;
    for (const double corner : faces[i]) {
      if (!(corner >= 0 && corner < static_cast<double>(soup.points.size()))) {
        throw InputError({source.file}, fmt::format("face {}: there is no vertex {}, only {}", i,
                                                    corner, soup.points.size()));
      }
      corners.push_back(static_cast<std::uint32_t>(corner));
    }
    try {
      add_polygon(soup, corners, cutting);
    } catch (const InputError& error) {
      throw InputError({source.file}, error.what());
    }
  }
  return soup;
}

}  // namespace isolux
