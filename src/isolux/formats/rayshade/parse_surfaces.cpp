#include <fmt/format.h>

#include <algorithm>

#include "isolux/formats/rayshade/parser.h"
#include "isolux/scene/spelling.h"

namespace isolux::rayshade {
namespace {

constexpr std::string_view kMirrors = "surfaces are diffuse, with 'diffuse' as their reflectance";
constexpr std::string_view kGlass = "surfaces are opaque, with 'diffuse' as their reflectance";

/// A word that says something about a surface, with that many numbers, and why it is left out.
struct Component {
  std::string_view word;
  int numbers;
  std::string_view reason;
};

constexpr Component kComponents[] = {
    {"ambient", 3, "light between surfaces is computed instead"},
    {"diffuse", 3, ""},
    {"specular", 3, kMirrors},
    {"specpow", 1, kMirrors},
    {"reflect", 1, kMirrors},
    {"body", 3, kGlass},
    {"transp", 1, kGlass},
    {"extinct", 1, kGlass},
    {"index", 1, kGlass},
    {"translucency", 5, kGlass},
    {"noshadow", 0, "everything casts shadows"},
};

const Component* find_component(std::string_view word) {
  const auto found = std::find_if(std::begin(kComponents), std::end(kComponents),
                                  [&](const Component& c) { return c.word == word; });
  return found == std::end(kComponents) ? nullptr : found;
}

}  // namespace

const SurfacePtr& default_surface() {
  static const SurfacePtr surface = std::make_shared<Surface>(Surface{"default", gray(0.6)});
  return surface;
}

bool Parser::component_follows(std::size_t ahead) {
  const Token& token = tokens_.peek(ahead);
  return token.kind == Token::Kind::word && find_component(token.text);
}

bool Parser::surface_follows() {
  return tokens_.name_follows() || tokens_.next_is("cursurf") || component_follows();
}

void Parser::surface_component(Surface& surface) {
  const Component* component = find_component(tokens_.take().text);
  if (component->word == "diffuse") {
    surface.diffuse = tokens_.color();
    const auto& [r, g, b] = surface.diffuse;
    surface.name = fmt::format("diffuse {:g} {:g} {:g}", r, g, b);
    return;
  }
  bool counts = component->numbers == 0;
  for (int i = 0; i < component->numbers; ++i) counts |= tokens_.number() != 0;
  if (counts) notes_.left_out(component->word, component->reason);
}

SurfacePtr Parser::surface() {
  SurfacePtr base = std::make_shared<Surface>(Surface{"black", {}});
  if (tokens_.name_follows()) {
    const Token token = tokens_.take();
    const auto found = surfaces_.find(token.text);
    if (found == surfaces_.end()) {
      std::vector<std::string_view> known;
      for (const auto& [name, surface] : surfaces_) known.push_back(name);
      fail(token.place, fmt::format("unknown surface {}: {}", in_quotes(token.text),
                                    suggestion(token.text, known)));
    }
    base = found->second;
  } else if (tokens_.accept("cursurf")) {
    base = current_.back() ? current_.back() : default_surface();
  } else if (!surface_follows()) {
    fail(tokens_.peek().place, "a surface must stand here: its name, or words such as 'diffuse'");
  }
  if (!component_follows()) return base;
  Surface changed = *base;
  while (component_follows()) surface_component(changed);
  return std::make_shared<Surface>(changed);
}

SurfacePtr Parser::optional_surface() { return surface_follows() ? surface() : current_.back(); }

SurfacePtr Parser::surface_before_name() {
  const bool plain = tokens_.name_follows() && !tokens_.name_follows(1) && !component_follows(1);
  return plain ? current_.back() : optional_surface();
}

void Parser::surface_definition() {
  const std::string name = tokens_.name("the name of a surface");
  Surface defined;
  if (surface_follows()) defined = *surface();
  defined.name = name;
  surfaces_.insert_or_assign(name, std::make_shared<Surface>(defined));
}

}  // namespace isolux::rayshade
