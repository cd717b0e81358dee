#include "isolux/formats/pbrt/directives.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "isolux/formats/pbrt/shapes.h"
#include "isolux/scene/spelling.h"

namespace isolux::pbrt {
namespace {

using std::numbers::pi;
constexpr std::size_t kDeepest = 1000;

}  // namespace

const std::map<std::string_view, Directives::Action> Directives::kActions = {
    {"AttributeBegin", &Directives::begin},
    {"AttributeEnd", &Directives::end},
    {"TransformBegin", &Directives::begin},
    {"TransformEnd", &Directives::end},
    {"Identity", &Directives::transform},
    {"Translate", &Directives::transform},
    {"Scale", &Directives::transform},
    {"Rotate", &Directives::transform},
    {"LookAt", &Directives::transform},
    {"Transform", &Directives::transform},
    {"ConcatTransform", &Directives::transform},
    {"CoordinateSystem", &Directives::coordinate_system},
    {"CoordSysTransform", &Directives::coordinate_system},
    {"ReverseOrientation", &Directives::reverse},
    {"WorldBegin", &Directives::begin_world},
    {"WorldEnd", &Directives::skip},
    {"Include", &Directives::include},
    {"Import", &Directives::include},
    {"Camera", &Directives::camera},
    {"Film", &Directives::film},
    {"Material", &Directives::material},
    {"MakeNamedMaterial", &Directives::material},
    {"NamedMaterial", &Directives::named_material},
    {"Texture", &Directives::texture},
    {"AreaLightSource", &Directives::area_light},
    {"LightSource", &Directives::light},
    {"Shape", &Directives::shape},
    {"ObjectBegin", &Directives::begin_object},
    {"ObjectEnd", &Directives::end_object},
    {"ObjectInstance", &Directives::place_object},
    {"Sampler", &Directives::skip},
    {"Integrator", &Directives::skip},
    {"SurfaceIntegrator", &Directives::skip},
    {"VolumeIntegrator", &Directives::skip},
    {"PixelFilter", &Directives::skip},
    {"Accelerator", &Directives::skip},
    {"Renderer", &Directives::skip},
    {"ColorSpace", &Directives::skip},
    {"Option", &Directives::skip},
    {"Attribute", &Directives::skip},
    {"MakeNamedMedium", &Directives::skip},
    {"MediumInterface", &Directives::skip},
    {"TransformTimes", &Directives::skip},
};

std::string take_text(const Token& directive, Lexer& lexer) {
  if (lexer.peek().kind != Token::Kind::text) {
    lexer.peek().fail(fmt::format("{} needs a text in quotes here", in_quotes(directive.text)));
  }
  return std::string(lexer.next().text);
}

std::vector<double> take_numbers(const Token& directive, Lexer& lexer, std::size_t count) {
  const bool bracket = lexer.peek().is("[");
  if (bracket) lexer.next();
  std::vector<double> numbers;
  while (numbers.size() < count) {
    if (lexer.peek().kind != Token::Kind::number) {
      lexer.peek().fail(fmt::format("{} needs {} numbers", in_quotes(directive.text), count));
    }
    numbers.push_back(lexer.next().number);
  }
  if (bracket && !lexer.peek().is("]")) {
    lexer.peek().fail(fmt::format("{} needs {} numbers", in_quotes(directive.text), count));
  }
  if (bracket) lexer.next();
  return numbers;
}

void Directives::read(const SourceText& source) {
  Lexer lexer(source);
  const std::size_t kept = kept_.size();
  while (lexer.peek().kind != Token::Kind::end) {
    const Token directive = lexer.next();
    run(directive, lexer);
  }
  if (kept_.size() > kept) {
    lexer.peek().fail(fmt::format("the file ends without {}", in_quotes(kept_.back().first)));
  }
}

void Directives::run(const Token& directive, Lexer& lexer) {
  const auto action = kActions.find(directive.text);
  if (directive.kind != Token::Kind::word || action == kActions.end()) {
    std::vector<std::string_view> words;
    for (const auto& [word, act] : kActions) words.push_back(word);
    directive.fail(fmt::format("unknown directive {}: {}", in_quotes(directive.text),
                               suggestion(directive.text, words)));
  }
  (this->*action->second)(directive, lexer);
}

void Directives::begin(const Token& directive, Lexer&) {
  if (kept_.size() == kDeepest) directive.fail("attributes nest too deep");
  kept_.emplace_back(directive.is("AttributeBegin") ? "AttributeEnd" : "TransformEnd", state_);
}

void Directives::end(const Token& directive, Lexer&) {
  if (kept_.empty() || kept_.back().first != directive.text) {
    directive.fail(fmt::format("{} has nothing to end here", in_quotes(directive.text)));
  }
  if (directive.is("AttributeEnd")) {
    state_ = std::move(kept_.back().second);
  } else {
    state_.map = kept_.back().second.map;
  }
  kept_.pop_back();
}

void Directives::transform(const Token& directive, Lexer& lexer) {
  const auto take = [&](std::size_t count) { return take_numbers(directive, lexer, count); };
  if (directive.is("Identity")) {
    state_.map = {};
  } else if (directive.is("Translate")) {
    const auto n = take(3);
    state_.map = state_.map * Affine::translate({n[0], n[1], n[2]});
  } else if (directive.is("Scale")) {
    const auto n = take(3);
    state_.map = state_.map * Affine::scale({n[0], n[1], n[2]});
  } else if (directive.is("Rotate")) {
    const auto n = take(4);
    const Vec3 axis{n[1], n[2], n[3]};
    if (!(length(axis) > 0)) directive.fail("the axis of 'Rotate' must not be zero");
    state_.map = state_.map * Affine::rotate(axis, n[0] * pi / 180);
  } else if (directive.is("LookAt")) {
    const auto n = take(9);
    const Vec3 eye{n[0], n[1], n[2]};
    const Vec3 ahead = normalized(Vec3{n[3], n[4], n[5]} - eye);
    const Vec3 right = normalized(cross(normalized(Vec3{n[6], n[7], n[8]}), ahead));
    if (!(length(right) > 0.5)) directive.fail("'LookAt' needs 'up' not along the view");
    const Affine to_camera{{right, cross(ahead, right), ahead}, {}};
    state_.map = state_.map * to_camera * Affine::translate(Vec3{} - eye);
  } else {
    const auto m = take(16);  // column by column
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
      directive.fail("the last row of a matrix must be 0 0 0 1");
    }
    const Affine map{{Vec3{m[0], m[4], m[8]}, Vec3{m[1], m[5], m[9]}, Vec3{m[2], m[6], m[10]}},
                     {m[12], m[13], m[14]}};
    state_.map = directive.is("Transform") ? map : state_.map * map;
  }
  if (!state_.map.inverse()) directive.fail("the transform flattens everything, or is too large");
}

void Directives::coordinate_system(const Token& directive, Lexer& lexer) {
  const Token name = lexer.peek();
  const std::string text = take_text(directive, lexer);
  if (directive.is("CoordinateSystem")) {
    systems_[text] = state_.map;
    return;
  }
  const auto found = systems_.find(text);
  if (found == systems_.end()) name.fail(fmt::format("there is no {}", in_quotes(text)));
  state_.map = found->second;
}

void Directives::reverse(const Token&, Lexer&) { state_.reversed = !state_.reversed; }

void Directives::begin_world(const Token&, Lexer&) { state_.map = {}; }

void Directives::include(const Token& directive, Lexer& lexer) {
  const Token name = lexer.peek();
  SourceText source;
  try {
    source = includes_.open(take_text(directive, lexer));
  } catch (const InputError& error) {
    name.fail(error.what());
  }
  read(source);
  includes_.close();
}

void Directives::camera(const Token& directive, Lexer& lexer) {
  const std::string kind = take_text(directive, lexer);
  const Parameters parameters(lexer);
  systems_["camera"] = *state_.map.inverse();
  if (kind != "perspective" && kind != "realistic") {
    return assembly_.notes().add("cameras that are not perspective: left out");
  }
  if (parameters.number("lensradius").value_or(0) > 0) {
    assembly_.notes().left_out("lensradius", "cameras are pinholes");
  }
  shorter_fov_ = parameters.number("fov").value_or(90);
  if (!(shorter_fov_ > 0 && shorter_fov_ < 180)) {
    parameters.find("fov")->fail("'fov' must lie between 0 and 180 degrees");
  }
  const Affine to_world = *state_.map.inverse();
  Camera camera;
  camera.name = "camera";
  camera.eye = to_world.point({});
  camera.look_at = camera.eye + normalized(to_world.vector({0, 0, 1}));
  camera.up = normalized(to_world.vector({0, 1, 0}));
  camera_ = camera;
  if (to_world.determinant() > 0) {
    assembly_.notes().add("axes of a left hand: pictures are mirror images of pbrt's");
  }
}

void Directives::film(const Token& directive, Lexer& lexer) {
  take_text(directive, lexer);
  const Parameters parameters(lexer);
  const auto size = [&](std::string_view name, int otherwise) {
    const auto number = parameters.number(name);
    if (!number) return otherwise;
    if (!(*number >= 1 && *number <= 32768)) {
      parameters.find(name)->fail(fmt::format("{} must be 1 to 32768", in_quotes(name)));
    }
    return static_cast<int>(*number);
  };
  width_ = size("xresolution", width_);
  height_ = size("yresolution", height_);
}

void Directives::shape(const Token& directive, Lexer& lexer) {
  const std::string kind = take_text(directive, lexer);
  const Parameters parameters(lexer);
  Part part{kind, nullptr, state_.look};
  const bool shines = state_.emitted && max_channel(*state_.emitted) > 0;
  part.look.two_sided = !shines;
  part.shape = make_shape(kind, parameters, state_.map, state_.reversed, !shines, directive.where,
                          includes_, assembly_);
  if (!part.shape) return;
  if (shines) {
    part.look.exitance = *state_.emitted;
    const auto area = surface_area(*part.shape);
    if (state_.flux > 0 && area) {
      part.look.exitance *= state_.flux / *area / luminance(*state_.emitted);
    }
  }
  if (part.look.material != "unnamed") part.name = part.look.material;
  if (object_) {
    object_->push_back(std::move(part));
  } else {
    made_at(directive.where, [&] { assembly_.add(part.name, part.shape, part.look); });
  }
}

void Directives::begin_object(const Token& directive, Lexer& lexer) {
  if (object_) directive.fail("'ObjectBegin' within an object");
  if (kept_.size() == kDeepest) directive.fail("attributes nest too deep");
  kept_.emplace_back("ObjectEnd", state_);
  object_ = &objects_[take_text(directive, lexer)];
}

void Directives::end_object(const Token& directive, Lexer&) {
  if (!object_ || kept_.empty() || kept_.back().first != directive.text) {
    directive.fail("'ObjectEnd' has nothing to end here");
  }
  state_ = std::move(kept_.back().second);
  kept_.pop_back();
  object_ = nullptr;
}

void Directives::place_object(const Token& directive, Lexer& lexer) {
  const Token name = lexer.peek();
  const auto found = objects_.find(take_text(directive, lexer));
  if (found == objects_.end()) {
    name.fail(fmt::format("there is no object {}", in_quotes(name.text)));
  }
  if (object_) directive.fail("'ObjectInstance' within an object");
  made_at(directive.where, [&] {
    for (const Part& part : found->second) {
      assembly_.add(found->first + '/' + part.name, assembly_.placed(part.shape, state_.map),
                    part.look);
    }
  });
}

void Directives::skip(const Token& directive, Lexer& lexer) {
  if (directive.is("MediumInterface") || directive.is("MakeNamedMedium")) {
    assembly_.notes().add("media: clear air");
  }
  if (lexer.peek().is("[")) {
    while (lexer.peek().kind != Token::Kind::end && !lexer.next().is("]")) {
    }
  }
  while (lexer.peek().kind == Token::Kind::number) lexer.next();
  const bool has_kind = !directive.is("Option");
  if (has_kind && lexer.peek().kind == Token::Kind::text) lexer.next();
  if (directive.is("MediumInterface") && lexer.peek().kind == Token::Kind::text) lexer.next();
  Parameters{lexer};
}

SceneFile Directives::finish() {
  if (camera_) {
    const double aspect = static_cast<double>(width_) / height_;
    const double half = std::tan(shorter_fov_ * pi / 360);
    camera_->fov = std::atan(aspect < 1 ? half / aspect : half) * 360 / pi;
    camera_->width = width_;
    camera_->height = height_;
    assembly_.cameras().push_back(*camera_);
  }
  assembly_.notes().add("no unit of length in pbrt: metres");
  return assembly_.finish();
}

}  // namespace isolux::pbrt
