#include "isolux/formats/rayshade/parser.h"

#include <fmt/format.h>

#include "isolux/geometry/require.h"
#include "isolux/scene/spelling.h"

namespace isolux::rayshade {
namespace {

constexpr int kLargestPicture = 32768;  ///< pixels a side
constexpr std::size_t kMostLights = 1000;
constexpr std::string_view kViewWords[] = {"eyep", "lookp", "up", "fov", "screen"};

}  // namespace

Parser::Parser(const SourceText& source, Notes& notes)
    : includes_(source.files.front(), Includes::Base::main_file),
      notes_(notes),
      tokens_(source),
      current_(1) {}

Model Parser::parse() {
  Members world;
  while (tokens_.peek().kind != Token::Kind::end) {
    if (tokens_.accept("define")) {
      tokens_.define();
    } else if (!object_item(world) && !view_item() && !light_item() && !skip_option()) {
      unknown_word(false);
    }
  }
  if (world.empty()) mention_the_named(world);
  model_.objects.assign(world.begin(), world.end());
  if (model_.objects.empty()) fail(tokens_.peek().place, "the scene is empty: it has no object");
  return std::move(model_);
}

/// A file made to be included has nothing but names: it shows what no other object mentions.
void Parser::mention_the_named(Members& world) {
  for (const auto& [name, node] : named_) {
    if (mentioned_.contains(node.get())) continue;
    const auto mention = std::make_shared<Node>();
    mention->geometry = Reference{node};
    mention->word = node->word;
    mention->place = node->place;
    finish(*mention);
    world.push_back(mention);
    notes_.add("the file only names objects: those that no other one mentions stand in the scene");
  }
}

void Parser::unknown_word(bool in_group) {
  const Token& token = tokens_.peek();
  if (token.kind != Token::Kind::word) {
    fail(token.place,
         fmt::format("{} can't stand here: is there a number too many?", in_quotes(token.text)));
  }
  std::vector<std::string_view> possible = object_words();
  if (in_group) {
    possible.push_back("end");
  } else {
    possible.insert(possible.end(), std::begin(kViewWords), std::end(kViewWords));
    possible.insert(possible.end(), {"light", "define"});
    for (const std::string_view word : option_words()) possible.push_back(word);
  }
  if (is_keyword(token.text)) {
    fail(token.place, fmt::format("{} can't stand {}", in_quotes(token.text),
                                  in_group ? "in a group of objects" : "here"));
  }
  fail(token.place,
       fmt::format("unknown word {}: {}", in_quotes(token.text), suggestion(token.text, possible)));
}

/// Three numbers within the limits of what shapes can be made of.
Vec3 Parser::point() {
  const Place place = tokens_.peek().place;
  const Vec3 p = tokens_.vector();
  try {
    require_point(p, "this point");
  } catch (const InputError& error) {
    fail(place, error.what());
  }
  return p;
}

bool Parser::view_item() {
  const Place place = tokens_.peek().place;
  View& view = model_.view;
  if (tokens_.accept("eyep")) {
    view.eye = point();
    if (const auto map = transforms()) view.eye = map->point(view.eye);
  } else if (tokens_.accept("lookp")) {
    view.look_at = point();
  } else if (tokens_.accept("up")) {
    view.up = point();
  } else if (tokens_.accept("fov")) {
    view.horizontal_fov = tokens_.number();
    view.vertical_fov.reset();
    if (tokens_.number_follows()) view.vertical_fov = tokens_.number();
    for (const double fov : {view.horizontal_fov, view.vertical_fov.value_or(1)}) {
      if (!(fov > 0 && fov < 180)) fail(place, "'fov' must lie between 0 and 180 degrees");
    }
  } else if (tokens_.accept("screen")) {
    view.width = tokens_.integer();
    view.height = tokens_.integer();
    if (std::min(view.width, view.height) < 1 ||
        std::max(view.width, view.height) > kLargestPicture) {
      fail(place, fmt::format("'screen' must have 1 to {} pixels a side", kLargestPicture));
    }
  } else {
    return false;
  }
  view.place = place;
  return true;
}

bool Parser::light_item() {
  const Place place = tokens_.peek().place;
  if (!tokens_.accept("light")) return false;
  light(place);
  return true;
}

void Parser::light(const Place& place) {
  Light light;
  light.place = place;
  const double first = tokens_.number();
  light.intensity = gray(first);
  if (tokens_.number_follows()) {
    light.intensity.g = tokens_.number();
    light.intensity.b = tokens_.number();
  }
  if (!(min_channel(light.intensity) >= 0 && max_channel(light.intensity) <= 1e6)) {
    fail(place, "the intensity of a light must lie between 0 and 1e6");
  }
  if (tokens_.accept("ambient")) {
    notes_.left_out("ambient", "light between surfaces is computed instead");
    return;
  }
  if (tokens_.accept("point")) {
    light.position = point();
  } else if (tokens_.accept("directional")) {
    light.kind = Light::Kind::directional;
    light.direction = point();
  } else if (tokens_.accept("extended")) {
    light.kind = Light::Kind::extended;
    light.radius = tokens_.number();
    light.position = point();
    if (!(light.radius >= kShortestLength && light.radius <= kLongestLength)) {
      fail(place, "the radius of an extended light must be more than 0");
    }
  } else if (tokens_.accept("spot")) {
    light.kind = Light::Kind::spot;
    light.position = point();
    light.direction = point() - light.position;
    notes_.left_out("the exponent of spot", "the beam fades between its angles alone");
    tokens_.number();
    if (tokens_.number_follows()) {
      light.full_angle = tokens_.number();
      light.dark_angle = tokens_.number();
      if (!(light.full_angle >= 0 && light.dark_angle >= 0.1 &&
            light.full_angle <= light.dark_angle && light.dark_angle <= 180)) {
        fail(place, "the angles of a spot light must rise, the second from 0.1 to 180 degrees");
      }
    }
  } else if (tokens_.accept("area")) {
    light.kind = Light::Kind::area;
    light.position = point();
    light.u = point() - light.position;
    tokens_.integer();
    light.v = point() - light.position;
    tokens_.integer();
    const double area = length(cross(light.u, light.v));
    if (!(area > 1e-9 * length(light.u) * length(light.v))) {
      fail(place, "the corners of an area light must not lie in a line");
    }
  } else {
    fail(tokens_.peek().place,
         fmt::format("unknown kind of light {}: {}", in_quotes(tokens_.peek().text),
                     suggestion(tokens_.peek().text,
                                {"ambient", "point", "directional", "extended", "spot", "area"})));
  }
  const bool aims = light.kind == Light::Kind::directional || light.kind == Light::Kind::spot;
  if (aims && !(length(light.direction) >= kShortestLength)) {
    fail(place, "the direction of a light must not be 0");
  }
  if (tokens_.accept("noshadow")) notes_.left_out("noshadow", "everything casts shadows");
  if (model_.lights.size() >= kMostLights) {
    fail(place, fmt::format("the scene has more than {} lights", kMostLights));
  }
  model_.lights.push_back(light);
}

}  // namespace isolux::rayshade
