#include "isolux/formats/rayshade/tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "isolux/scene/spelling.h"

namespace isolux::rayshade {
namespace {

constexpr int kDeepest = 100;  ///< of parentheses in each other

/// In alphabetical order.
constexpr std::string_view kKeywords[] = {
    "ambient",     "aperture",    "applysurf",   "area",      "atmosphere",   "background",
    "blob",        "blotch",      "body",        "box",       "bump",         "checker",
    "cloud",       "component",   "cone",        "contrast",  "crop",         "cursurf",
    "cutoff",      "cylinder",    "cylindrical", "define",    "difference",   "diffuse",
    "directional", "disc",        "end",         "extended",  "extinct",      "eyep",
    "eyesep",      "fbm",         "fbmbump",     "filter",    "focaldist",    "fog",
    "fogdeck",     "fov",         "framelength", "frames",    "gauss",        "gloss",
    "grid",        "heightfield", "image",       "index",     "intersect",    "jitter",
    "jittered",    "light",       "list",        "lookp",     "map",          "marble",
    "maxdepth",    "mist",        "mount",       "name",      "nojitter",     "noshadow",
    "object",      "outfile",     "planar",      "plane",     "point",        "poly",
    "print",       "quiet",       "range",       "reflect",   "report",       "rotate",
    "sample",      "samples",     "scale",       "screen",    "shadowtransp", "shutter",
    "sky",         "smooth",      "specpow",     "specular",  "sphere",       "spherical",
    "spot",        "starttime",   "stripe",      "surface",   "textsurf",     "texture",
    "tile",        "torus",       "transform",   "translate", "translucency", "transp",
    "triangle",    "triangleuv",  "union",       "up",        "uv",           "verbose",
    "window",      "windy",       "wood"};

struct Function {
  std::string_view name;
  std::size_t arguments;
  double (*of)(const double* x, double time);
};

constexpr Function kFunctions[] = {
    {"sin", 1, [](const double* x, double) { return std::sin(x[0]); }},
    {"cos", 1, [](const double* x, double) { return std::cos(x[0]); }},
    {"tan", 1, [](const double* x, double) { return std::tan(x[0]); }},
    {"asin", 1, [](const double* x, double) { return std::asin(x[0]); }},
    {"acos", 1, [](const double* x, double) { return std::acos(x[0]); }},
    {"atan", 1, [](const double* x, double) { return std::atan(x[0]); }},
    {"sqrt", 1, [](const double* x, double) { return std::sqrt(x[0]); }},
    {"hypot", 2, [](const double* x, double) { return std::hypot(x[0], x[1]); }},
    // From x[1] at the time x[0] to x[3] at the time x[2].
    {"linear", 4,
     [](const double* x, double time) {
       if (time < x[0] || x[0] == x[2]) return x[1];
       if (time > x[2]) return x[3];
       return x[1] + (x[3] - x[1]) * (time - x[0]) / (x[2] - x[0]);
     }},
};

/// How tightly an operator binds: 1 for sums, 2 for products, 4 for powers (3 being a sign before a
/// number); 0 for what is no operator.
int precedence_of(const Token& token) {
  if (token.is("+") || token.is("-")) return 1;
  if (token.is("*") || token.is("/") || token.is("%")) return 2;
  return token.is("^") ? 4 : 0;
}

double apply(char sign, double a, double b) {
  switch (sign) {
    case '+':
      return a + b;
    case '-':
      return a - b;
    case '*':
      return a * b;
    case '/':
      return a / b;
    case '%':
      return std::fmod(std::trunc(a), std::trunc(b));
    default:
      return std::pow(a, b);
  }
}

std::string described(const Token& token) {
  return token.kind == Token::Kind::end ? "the end of the file" : in_quotes(token.text);
}

}  // namespace

bool is_keyword(std::string_view word) {
  return std::find(std::begin(kKeywords), std::end(kKeywords), word) != std::end(kKeywords);
}

Tokens::Tokens(const SourceText& source) : lexer_(source) {
  using std::numbers::pi;
  variables_ = {{"pi", pi}, {"dtor", pi / 180}, {"rtod", 180 / pi}, {"time", 0}, {"frame", 0}};
}

const Token& Tokens::peek(std::size_t ahead) {
  while (ahead_.size() <= ahead) ahead_.push_back(lexer_.next());
  return ahead_[ahead];
}

Token Tokens::take() {
  const Token token = peek();
  ahead_.pop_front();
  return token;
}

bool Tokens::accept(std::string_view word) {
  if (!next_is(word)) return false;
  take();
  return true;
}

bool Tokens::number_follows() {
  return peek().kind == Token::Kind::number || next_is("(") || next_is("-") || next_is("+");
}

bool Tokens::name_follows(std::size_t ahead) {
  return peek(ahead).kind == Token::Kind::word && !is_keyword(peek(ahead).text);
}

double Tokens::number() {
  if (!number_follows()) {
    fail(peek().place, fmt::format("a number must stand here, not {}", described(peek())));
  }
  double sign = 1;
  if (peek().kind == Token::Kind::sign && !next_is("(")) sign = take().text == "-" ? -1 : 1;
  if (peek().kind == Token::Kind::number) return sign * take().number;
  const Place start = peek().place;
  expect("(");
  const double value = sign * expression(1);
  expect(")");
  if (!std::isfinite(value)) fail(start, "this expression comes to no finite number");
  return value;
}

int Tokens::integer() {
  const Place place = peek().place;
  const double value = std::trunc(number());
  if (!(std::abs(value) <= 1e9)) fail(place, "this number is too large");
  return static_cast<int>(value);
}

Vec3 Tokens::vector() {
  const double x = number(), y = number();
  return {x, y, number()};
}

Rgb Tokens::color() {
  const Place place = peek().place;
  const Vec3 v = vector();
  if (!(v.x >= 0 && v.y >= 0 && v.z >= 0)) fail(place, "a color must not be negative");
  return {v.x, v.y, v.z};
}

void Tokens::skip_numbers(int count) {
  for (; count > 0; --count) number();
}

std::string Tokens::name(const char* what) {
  if (name_follows()) return std::string(take().text);
  const Token& token = peek();
  const bool reserved = token.kind == Token::Kind::word;
  fail(token.place, fmt::format("{} must stand here, not {}{}", what, described(token),
                                reserved ? ", a word of the language" : ""));
}

std::string Tokens::filename() {
  if (peek().kind == Token::Kind::word) return std::string(take().text);
  fail(peek().place, fmt::format("the name of a file must stand here, not {}", described(peek())));
}

void Tokens::expect(std::string_view sign) {
  if (accept(sign)) return;
  fail(peek().place, fmt::format("'{}' must stand here, not {}", sign, described(peek())));
}

void Tokens::define() {
  const Place place = peek().place;
  const std::string variable = name("the name of a variable");
  const double value = number();
  if (!variables_.emplace(variable, value).second) {
    fail(place,
         fmt::format("variable {} is there already: choose another name", in_quotes(variable)));
  }
}

/// An expression of operators that bind at least as tightly as that.
double Tokens::expression(int precedence) {
  if (depth_ >= kDeepest) fail(peek().place, "parentheses and signs nested too deep");
  ++depth_;
  double value = 0;
  if (next_is("-") || next_is("+")) {
    value = take().text == "-" ? -expression(3) : expression(3);
  } else {
    value = operand();
  }
  for (int next = precedence_of(peek()); next >= precedence && next > 0;
       next = precedence_of(peek())) {
    const char sign = take().text[0];
    // Of powers in a row the last comes first; all else goes from left to right.
    value = apply(sign, value, expression(next == 4 ? next : next + 1));
  }
  --depth_;
  return value;
}

double Tokens::operand() {
  if (accept("(")) {
    const double value = expression(1);
    expect(")");
    return value;
  }
  const Token token = take();
  if (token.kind == Token::Kind::number) return token.number;
  if (token.kind != Token::Kind::word) {
    fail(token.place, fmt::format("a number must stand here, not {}", described(token)));
  }
  if (next_is("(")) return function(token);
  if (const auto found = variables_.find(token.text); found != variables_.end()) {
    return found->second;
  }
  std::vector<std::string_view> known;
  for (const auto& [name, value] : variables_) known.push_back(name);
  fail(token.place, fmt::format("unknown variable {}: {}", in_quotes(token.text),
                                suggestion(token.text, known)));
}

double Tokens::function(const Token& name) {
  const auto found = std::find_if(std::begin(kFunctions), std::end(kFunctions),
                                  [&](const Function& f) { return f.name == name.text; });
  if (found == std::end(kFunctions)) {
    std::vector<std::string_view> known;
    for (const Function& f : kFunctions) known.push_back(f.name);
    fail(name.place, fmt::format("unknown function {}: {}", in_quotes(name.text),
                                 suggestion(name.text, known)));
  }
  double arguments[4] = {};
  expect("(");
  for (std::size_t i = 0; i < found->arguments; ++i) {
    if (i > 0) expect(",");
    arguments[i] = expression(1);
  }
  expect(")");
  return found->of(arguments, variables_.at("time"));
}

}  // namespace isolux::rayshade
