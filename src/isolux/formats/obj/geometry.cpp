#include "isolux/formats/obj/geometry.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "isolux/formats/limits.h"
#include "isolux/formats/statement_reader.h"
#include "isolux/scene/spelling.h"

namespace isolux {

void obj::Vertices::read(const Statement& line) {
  line.expect_arguments(3, 7, "v x y z");
  const Vec3 point{line.number(1), line.number(2), line.number(3)};
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(point[axis]) <= kFarthest) continue;
    line.fail(axis + 1, fmt::format("must lie between -{0:g} and {0:g}", kFarthest));
  }
  points_.push_back(point);
}

std::uint32_t obj::Vertices::corner(const Statement& face, std::size_t i) const {
  const std::string_view word = face.word(i).substr(0, face.word(i).find('/'));
  long long number = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (fault != std::errc{} || end != word.data() + word.size()) {
    face.fail(i, fmt::format("expected the number of a vertex, not {}", in_quotes(face.word(i))));
  }
  const auto count = static_cast<long long>(points_.size());
  if (number == 0 || number > count || number < -count) {
    face.fail(i, fmt::format("there is no vertex {} here, only {}", number, count));
  }
  return static_cast<std::uint32_t>(number > 0 ? number - 1 : count + number);
}

TriangleSoup parse_obj(const SourceText& source, Cutting& cutting) {
  obj::Vertices vertices;
  TriangleSoup soup;
  StatementReader statements(source);
  while (const auto s = statements.next()) {
    if (s->word(0) == "v") vertices.read(*s);
    if (s->word(0) != "f") continue;
    s->expect_arguments(3, Statement::kAnyNumber, "f v1 v2 v3 ...");
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 1; i < s->size(); ++i) corners.push_back(vertices.corner(*s, i));
    const auto& points = vertices.points();
    soup.points.insert(soup.points.end(), points.begin() + soup.points.size(), points.end());
    try {
      add_polygon(soup, corners, cutting);
    } catch (const InputError& error) {
      s->fail(0, error.what());
    }
  }
  return soup;
}

}  // namespace isolux
