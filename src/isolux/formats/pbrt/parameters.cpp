#include "isolux/formats/pbrt/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "isolux/formats/colorimetry.h"
#include "isolux/scene/spelling.h"

namespace isolux::pbrt {
namespace {

void add_value(Parameter& parameter, const Token& token) {
  if (token.kind == Token::Kind::number) {
    parameter.numbers.push_back(token.number);
  } else if (token.kind == Token::Kind::text || token.is("true") || token.is("false")) {
    parameter.texts.push_back(token.text);
  } else {
    token.fail(token.kind == Token::Kind::end
                   ? "the file ends within a directive"
                   : fmt::format("expected a value, not {}", in_quotes(token.text)));
  }
}

Parameter read_parameter(Lexer& lexer) {
  constexpr std::string_view kBlanks = " \t";
  const Token head = lexer.next();
  const std::size_t begin = head.text.find_first_not_of(kBlanks);
  const std::size_t blank = head.text.find_first_of(kBlanks, begin);
  const std::size_t name = head.text.find_first_not_of(kBlanks, blank);
  if (begin == std::string_view::npos || name == std::string_view::npos) {
    head.fail(fmt::format("expected a type and a name, not {}", in_quotes(head.text)));
  }
  Parameter parameter;
  parameter.where = head.where;
  parameter.type = head.text.substr(begin, blank - begin);
  parameter.name = head.text.substr(name, head.text.find_first_of(kBlanks, name) - name);
  if (!lexer.peek().is("[")) {
    add_value(parameter, lexer.next());
    return parameter;
  }
  lexer.next();
  while (!lexer.peek().is("]")) add_value(parameter, lexer.next());
  lexer.next();
  return parameter;
}

}  // namespace

Parameters::Parameters(Lexer& lexer) {
  while (lexer.peek().kind == Token::Kind::text) all_.push_back(read_parameter(lexer));
}

const Parameter* Parameters::find(std::string_view name) const {
  const auto found =
      std::find_if(all_.begin(), all_.end(), [&](const Parameter& p) { return p.name == name; });
  return found == all_.end() ? nullptr : &*found;
}

std::optional<double> Parameters::number(std::string_view name) const {
  const Parameter* const p = find(name);
  if (!p) return std::nullopt;
  if (p->numbers.size() != 1) p->fail(fmt::format("{} must be one number", in_quotes(name)));
  return p->numbers[0];
}

std::vector<Vec3> Parameters::points(std::string_view name) const {
  const Parameter* const p = find(name);
  if (!p) return {};
  if (p->numbers.size() % 3 != 0) p->fail(fmt::format("{} needs triples", in_quotes(name)));
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < p->numbers.size(); i += 3) {
    points.push_back({p->numbers[i], p->numbers[i + 1], p->numbers[i + 2]});
  }
  return points;
}

std::optional<Vec3> Parameters::point(std::string_view name) const {
  const Parameter* const p = find(name);
  if (!p) return std::nullopt;
  if (p->numbers.size() != 3) p->fail(fmt::format("{} must be three numbers", in_quotes(name)));
  return points(name).front();
}

std::vector<std::uint32_t> Parameters::indices(std::string_view name, std::size_t limit) const {
  const Parameter* const p = find(name);
  if (!p) return {};
  std::vector<std::uint32_t> indices;
  for (const double number : p->numbers) {
    if (!(number >= 0 && number < static_cast<double>(limit)) || number != std::floor(number)) {
      p->fail(fmt::format("there is no point {}, only {} of them", number, limit));
    }
    indices.push_back(static_cast<std::uint32_t>(number));
  }
  return indices;
}

std::string_view Parameters::text(std::string_view name) const {
  const Parameter* const p = find(name);
  if (!p) return {};
  if (p->texts.size() != 1) p->fail(fmt::format("{} must be one text", in_quotes(name)));
  return p->texts[0];
}

bool Parameters::flag(std::string_view name) const { return text(name) == "true"; }

std::optional<Rgb> Parameters::color(std::string_view name) const {
  const Parameter* const p = find(name);
  if (!p || p->type == "texture" || !p->texts.empty()) return std::nullopt;
  for (const double number : p->numbers) {
    if (number < 0) p->fail(fmt::format("{} must not be negative", in_quotes(name)));
  }
  const auto& n = p->numbers;
  if (p->type == "blackbody" && (n.size() == 1 || n.size() == 2)) {
    if (!(n[0] >= 100 && n[0] <= 1e6)) p->fail("a temperature lies between 100 and 1000000 K");
    const Rgb color = rec709(xyz_of_black_body(n[0])) * (n.size() == 2 ? n[1] : 1);
    return paled_into_range(color, std::numeric_limits<double>::infinity());
  }
  if (n.size() == 1) return gray(n[0]);
  if ((p->type == "rgb" || p->type == "color") && n.size() == 3) return Rgb{n[0], n[1], n[2]};
  if (p->type == "spectrum") return std::nullopt;
  p->fail(fmt::format("{} must be a number or a color", in_quotes(name)));
}

}  // namespace isolux::pbrt
