#include "isolux/formats/mesh/stl.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "isolux/core/error.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/statement_reader.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kHeader = 80, kFacet = 50;  // bytes

template <typename Number>
Number at(const std::string& bytes, std::size_t offset) {
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

/// Whether the file has the size of a binary one with the count that it says.
bool is_binary(const std::string& bytes) {
  return bytes.size() >= kHeader + 4 &&
         bytes.size() == kHeader + 4 + kFacet * std::size_t{at<std::uint32_t>(bytes, kHeader)};
}

void add_triangle(TriangleSoup& soup) {
  const auto n = static_cast<std::uint32_t>(soup.points.size());
  soup.triangles.push_back({n - 3, n - 2, n - 1});
}

StlSolid parse_binary(const SourceText& source) {
  StlSolid solid;
  for (std::size_t facet = kHeader + 4; facet < source.text.size(); facet += kFacet) {
    for (std::size_t corner = 1; corner <= 3; ++corner) {  // behind the normal
      Vec3 point;
      for (int axis = 0; axis < 3; ++axis) {
        point[axis] = at<float>(source.text, facet + 12 * corner + 4 * axis);
        if (std::abs(point[axis]) <= kFarthest) continue;
        throw InputError({source.file},
                         fmt::format("triangle {0}: coordinates must lie between -{1:g} and {1:g}",
                                     solid.soup.triangles.size(), kFarthest));
      }
      solid.soup.points.push_back(point);
    }
    add_triangle(solid.soup);
  }
  return solid;
}

/// The lines of a text, each expected at its place.
class Parser {
 public:
  explicit Parser(const SourceText& source) : source_(source), statements_(source) {}

  std::vector<StlSolid> parse() {
    std::vector<StlSolid> solids;
    while (const auto s = statements_.next()) {
      expect(*s, "solid");
      solids.push_back({s->size() > 1 ? std::string(s->word(1)) : std::string(), {}});
      parse_facets(solids.back().soup);
    }
    return solids;
  }

 private:
  Statement next() {
    auto s = statements_.next();
    if (!s) throw InputError({source_.file}, "the file ends within a solid");
    return std::move(*s);
  }
  static void expect(const Statement& s, std::string_view word) {
    if (s.word(0) != word) {
      s.fail(0, fmt::format("expected {}, not {}", in_quotes(word), in_quotes(s.word(0))));
    }
  }
  void parse_facets(TriangleSoup& soup) {
    for (Statement s = next(); s.word(0) != "endsolid"; s = next()) {
      expect(s, "facet");
      expect(next(), "outer");
      for (int corner = 0; corner < 3; ++corner) soup.points.push_back(parse_vertex());
      add_triangle(soup);
      expect(next(), "endloop");
      expect(next(), "endfacet");
    }
  }
  Vec3 parse_vertex() {
    const Statement s = next();
    expect(s, "vertex");
    s.expect_arguments(3, 3, "vertex x y z");
    const Vec3 point{s.number(1), s.number(2), s.number(3)};
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(point[axis]) <= kFarthest) continue;
      s.fail(axis + 1, fmt::format("must lie between -{0:g} and {0:g}", kFarthest));
    }
    return point;
  }

  const SourceText& source_;
  StatementReader statements_;
};

}  // namespace

std::vector<StlSolid> parse_stl(const SourceText& source) {
  if (is_binary(source.text)) return {parse_binary(source)};
  if (source.text.find('\0') != std::string::npos) {
    throw InputError({source.file}, "the file is cut off, or no STL");
  }
  return Parser(source).parse();
}

}  // namespace isolux
