#include "isolux/formats/radiance/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "isolux/formats/colorimetry.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/object_names.h"
#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace {

using std::numbers::pi;

enum class Kind { coated, translucent, measured, light, spotlight, mirror, black, clear };

struct MaterialType {
  std::string_view name;
  Kind kind;
  std::size_t least, most;  ///< numbers
  std::string_view usage;
  std::size_t transmission = 0;  ///< which of the numbers says how much goes in
};

constexpr std::size_t kMostModifiers = 1'000'000;
constexpr std::size_t kAny = 1'000'000;
constexpr std::string_view kCoated = "red green blue specularity roughness";
constexpr std::string_view kAnyCoated = "red green blue specularity ...";
constexpr std::string_view kLight = "red green blue";
constexpr MaterialType kMaterials[] = {
    {"plastic", Kind::coated, 5, 5, kCoated},
    {"metal", Kind::coated, 5, 5, kCoated},
    {"plastic2", Kind::coated, 6, 6, "red green blue specularity roughness roughness"},
    {"metal2", Kind::coated, 6, 6, "red green blue specularity roughness roughness"},
    {"plasfunc", Kind::coated, 4, kAny, kAnyCoated},
    {"metfunc", Kind::coated, 4, kAny, kAnyCoated},
    {"plasdata", Kind::coated, 4, kAny, kAnyCoated},
    {"metdata", Kind::coated, 4, kAny, kAnyCoated},
    {"trans", Kind::translucent, 7, 7,
     "red green blue specularity roughness transmissivity specular-transmissivity", 5},
    {"trans2", Kind::translucent, 8, 8,
     "red green blue specularity roughness roughness transmissivity specular-transmissivity", 6},
    {"transfunc", Kind::translucent, 6, kAny,
     "red green blue specularity transmissivity specular-transmissivity ...", 4},
    {"transdata", Kind::translucent, 6, kAny,
     "red green blue specularity transmissivity specular-transmissivity ...", 4},
    {"BRTDfunc", Kind::measured, 9, kAny, "the diffuse reflectances of front and back ..."},
    {"ashik2", Kind::measured, 8, 8,
     "diffuse red green blue, specular red green blue, u-power v-power"},
    {"BSDF", Kind::measured, 0, 9, "diffuse reflectances and transmittance, 0, 3, 6 or 9 numbers"},
    {"aBSDF", Kind::measured, 0, 9, "diffuse reflectances and transmittance, 0, 3, 6 or 9 numbers"},
    {"WGMDfunc", Kind::black, 0, kAny, ""},
    {"light", Kind::light, 3, 3, kLight},
    {"illum", Kind::light, 3, 3, kLight},
    {"glow", Kind::light, 4, 4, "red green blue radius"},
    {"spotlight", Kind::spotlight, 7, 7, "red green blue angle x y z"},
    {"mirror", Kind::mirror, 3, 3, kLight},
    {"glass", Kind::clear, 3, 4, kLight},
    {"dielectric", Kind::clear, 5, 5, "red green blue index hartmann"},
    {"interface", Kind::clear, 8, 8, "red green blue index, inside and outside"},
    {"prism1", Kind::clear, 0, kAny, ""},
    {"prism2", Kind::clear, 0, kAny, ""},
    {"mist", Kind::clear, 0, kAny, ""},
    {"antimatter", Kind::clear, 0, kAny, ""},
};
constexpr std::string_view kPatterns[] = {"brightfunc", "brightdata", "brighttext", "colorfunc",
                                          "colordata",  "colorpict",  "colortext",  "spectrum",
                                          "specfile",   "specfunc",   "specdata",   "specpict"};
constexpr std::string_view kTextures[] = {"texfunc", "texdata"};
constexpr std::string_view kMixtures[] = {"mixfunc", "mixdata", "mixpict", "mixtext"};

// The places in modifiers_ of those that are there from the start.
constexpr std::size_t kVoid = 0, kUndefined = 1;

/// The table's own copy of a word, or an empty one.
template <typename Table>
std::string_view listed(const Table& table, std::string_view word) {
  const auto found = std::find(std::begin(table), std::end(table), word);
  return found == std::end(table) ? std::string_view{} : *found;
}

const MaterialType* material_type(std::string_view name) {
  const auto found = std::find_if(std::begin(kMaterials), std::end(kMaterials),
                                  [&](const MaterialType& t) { return t.name == name; });
  return found == std::end(kMaterials) ? nullptr : found;
}

/// Numbers i to i + 2, none negative.
Rgb color(const Primitive& p, std::size_t i) {
  for (std::size_t k = i; k < i + 3; ++k) {
    if (p.number(k) < 0) p.numbers.fail(k + 1, "a color must not be negative");
  }
  return {p.number(i), p.number(i + 1), p.number(i + 2)};
}

/// Number i, from 0 to 1.
double share(const Primitive& p, std::size_t i) {
  const double value = p.number(i);
  if (value >= 0 && value <= 1) return value;
  p.numbers.fail(i + 1, fmt::format("must lie between 0 and 1, but is {}", value));
}

Rgb emitted(const Primitive& p, double part) {
  const Rgb exitance = luminance_of_radiance(color(p, 0)) * (pi * part);
  if (max_channel(exitance) <= kMostExitance) return exitance;
  p.numbers.fail(1, fmt::format("more than {:g} lm/m² would leave this light", kMostExitance));
}

/// That of a modifier with others behind it: two skies are none.
LightPattern combined(const LightPattern& own, const LightPattern& behind) {
  if (!own.sky && !own.other) return behind;
  if (!behind.sky && !behind.other) return own;
  return {nullptr, true};
}

}  // namespace

bool is_modifier(std::string_view type) {
  return type == "alias" || material_type(type) || !listed(kPatterns, type).empty() ||
         !listed(kTextures, type).empty() || !listed(kMixtures, type).empty();
}

std::vector<std::string_view> modifier_types() {
  std::vector<std::string_view> all{"alias"};
  for (const MaterialType& type : kMaterials) all.push_back(type.name);
  all.insert(all.end(), std::begin(kPatterns), std::end(kPatterns));
  all.insert(all.end(), std::begin(kTextures), std::end(kTextures));
  all.insert(all.end(), std::begin(kMixtures), std::end(kMixtures));
  return all;
}

Materials::Materials(Notes& notes) : notes_(notes) {
  Finish nothing, gray_one;
  nothing.solid = false;
  gray_one.name = "undefined";
  gray_one.reflectance = gray(0.5);
  finishes_ = {nothing, gray_one};
  modifiers_.resize(2);
  modifiers_[kVoid].type = "void";
  modifiers_[kVoid].change = "surfaces without a material are left out, light passes unhindered";
  modifiers_[kUndefined].finish = 1;
  modifiers_[kUndefined].next = kUndefined;
  modifiers_[kUndefined].noted = true;  // by note_undefined()
  modifiers_[kUndefined].pattern.other = true;
}

std::size_t Materials::find(std::string_view name) const {
  if (name == "void") return kVoid;
  const auto found = numbers_.find(std::string(name));
  return found == numbers_.end() ? kUndefined : found->second;
}

std::size_t Materials::require(std::string_view name) {
  const std::size_t number = find(name);
  if (number == kUndefined) undefined_.insert(clean_name(name));
  return number;
}

void Materials::define(const Primitive& p, const Affine& map) {
  if (modifiers_.size() > kMostModifiers) {
    p.head.fail(0, fmt::format("the scene has more than {} modifiers", kMostModifiers));
  }
  Modifier modifier;
  const std::string_view type = p.type();
  if (type == "alias") {
    modifier = alias(p);
  } else if (const MaterialType* const material = material_type(type)) {
    modifier.type = material->name;
    modifier.next = modifiers_.size();
    modifier.pattern = modifiers_[find(p.modifier())].pattern;
    define_material(p, modifier);
  } else if (const std::string_view mixture = listed(kMixtures, type); !mixture.empty()) {
    if (p.strings.size() < 3)
      p.strings.fail(0, "a mixture has two modifiers: foreground, background");
    modifier.type = mixture;
    modifier.change = "mixtures are their foreground alone, their background where that is void";
    // Mixtures of patterns leave the material to the modifier behind them.
    for (const std::size_t part :
         {require(p.strings.word(1)), require(p.strings.word(2)), require(p.modifier())}) {
      modifier.next = part;
      if (modifiers_[part].finish != modifiers_[kVoid].finish) break;
    }
    modifier.finish = modifiers_[modifier.next].finish;
    modifier.pattern.other = modifier.own_pattern.other = true;
  } else {
    const std::string_view pattern = listed(kPatterns, type);
    modifier.type = pattern.empty() ? listed(kTextures, type) : pattern;
    modifier.change = pattern.empty() ? "surfaces are flat, without textures"
                                      : "surfaces have the plain color of their material";
    modifier.next = require(p.modifier());
    modifier.finish = modifiers_[modifier.next].finish;
    if (const auto sky = read_sky_pattern(p, map)) {
      modifier.own_pattern.sky = std::make_shared<SkyPattern>(*sky);
    } else {
      modifier.own_pattern.other = !pattern.empty();
    }
    modifier.pattern = combined(modifier.own_pattern, modifiers_[modifier.next].pattern);
  }
  modifiers_.push_back(std::move(modifier));
  numbers_[std::string(p.name())] = modifiers_.size() - 1;
}

/// What an alias stands for, with its own modifier behind it unless it inherits that too.
Materials::Modifier Materials::alias(const Primitive& p) {
  Modifier modifier = modifiers_[require(p.strings.word(1))];
  if (p.modifier() != "inherit") {
    const bool looked_through =
        !listed(kPatterns, modifier.type).empty() || !listed(kTextures, modifier.type).empty();
    if (looked_through) {
      modifier.next = require(p.modifier());
      modifier.finish = modifiers_[modifier.next].finish;
    }
    modifier.pattern = combined(modifier.own_pattern, modifiers_[find(p.modifier())].pattern);
  }
  if (material_type(modifier.type)) {
    finishes_.push_back(finishes_[modifier.finish]);
    finishes_.back().name = clean_name(p.name());
    modifier.finish = finishes_.size() - 1;
  }
  return modifier;
}

void Materials::define_material(const Primitive& p, Modifier& modifier) {
  const MaterialType& type = *material_type(modifier.type);
  p.expect_numbers(type.least, type.most, type.usage);
  Finish finish;
  finish.name = clean_name(p.name());
  switch (type.kind) {
    case Kind::coated:
    case Kind::translucent:
      finish.reflectance = color(p, 0) * (1 - share(p, 3));
      if (share(p, 3) > 0)
        modifier.change = "its gloss is absorbed, the diffuse part alone is kept";
      if (type.kind == Kind::translucent) {
        finish.reflectance *= 1 - share(p, type.transmission);
        modifier.change = "nothing shines through, the diffusely reflected part alone is kept";
      }
      break;
    case Kind::measured:
      if (p.number_count() >= 3) finish.reflectance = color(p, 0);
      modifier.change = "the diffuse reflectance of its front is kept, all else is absorbed";
      break;
    case Kind::light:
      finish.exitance = emitted(p, 1);
      if (type.name == "illum")
        modifier.change = "it is seen as a light, not as what it stands for";
      if (type.name == "glow" && p.number(3) < 0) {
        finish.exitance = {};
        modifier.change = "where it must not light anything (radius below 0), it is black";
      }
      break;
    case Kind::spotlight: {
      const double angle = std::min(std::abs(p.number(3)), 180.0);
      finish.exitance = emitted(p, std::pow(std::sin(0.5 * angle * pi / 180), 2));
      modifier.change = "the flux of its beam leaves the surface diffusely";
      break;
    }
    case Kind::mirror:
      modifier.change = "it is black, what it reflects is absorbed";
      if (p.strings.size() > 1 && p.strings.word(1) != "void") {
        const std::size_t other = find(p.strings.word(1));
        finish.reflectance = finishes_[modifiers_[other].finish].reflectance;
        modifier.change = "its other material stands for it";
      }
      break;
    case Kind::black:
      modifier.change = "it is black";
      break;
    case Kind::clear:
      finish.solid = false;
      modifier.change = "its surfaces are left out, light passes unhindered";
      break;
  }
  modifier.clamped = max_channel(finish.reflectance) > kMostReflectance;
  const auto clamp = [](double& channel) { channel = std::min(channel, kMostReflectance); };
  clamp(finish.reflectance.r), clamp(finish.reflectance.g), clamp(finish.reflectance.b);
  modifier.finish = finishes_.size();
  finishes_.push_back(std::move(finish));
}

void Materials::note(Modifier& modifier) {
  modifier.noted = true;
  if (!modifier.change.empty()) notes_.changed(modifier.type, modifier.change);
  if (modifier.clamped) notes_.add("reflectance of 1 or more: reduced to 0.999");
}

const Finish& Materials::finish_of(std::string_view name) {
  const std::size_t first = require(name);
  for (std::size_t i = first; !modifiers_[i].noted; i = modifiers_[i].next) note(modifiers_[i]);
  const Finish& finish = finishes_[modifiers_[first].finish];
  if (modifiers_[first].pattern.sky && max_channel(finish.exitance) > 0) {
    notes_.add("lights with the pattern of a sky that are none: they shine by their color alone");
  }
  return finish;
}

SourceLight Materials::source_light_of(std::string_view name) {
  const std::size_t first = require(name);
  std::size_t last = first;  // of the chain: its material
  while (modifiers_[last].next != last) last = modifiers_[last].next;
  if (last != kVoid && !modifiers_[last].noted) note(modifiers_[last]);
  return {finishes_[modifiers_[first].finish].exitance / pi, modifiers_[first].pattern};
}

void Materials::note_undefined() const {
  if (undefined_.empty()) return;
  notes_.add(fmt::format("undefined {}: surfaces have a reflectance of 0.5",
                         enumerated({undefined_.begin(), undefined_.end()})));
}

}  // namespace isolux::radiance
