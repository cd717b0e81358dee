// BSDFs and textures.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "isolux/formats/mitsuba/builder.h"
#include "isolux/formats/mitsuba/parameters.h"
#include "isolux/scene/spelling.h"

namespace isolux::mitsuba {
namespace {

constexpr std::size_t kDeepest = 64;

using Types = std::vector<std::string_view>;
bool is_one_of(std::string_view type, const Types& types) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

const Types kCoated = {"plastic", "roughplastic", "pplastic", "phong", "ward"};
const Types kBlack = {"conductor", "roughconductor"};
const Types kClear = {"dielectric", "thindielectric", "roughdielectric", "null"};
const Types kPrincipled = {"principled", "principledthin"};
const Types kAroundAnother = {"bumpmap", "normalmap", "mask", "coating", "roughcoating"};

}  // namespace

/// As long as it lives, its element is being looked at; those within one another must come to an
/// end.
class Builder::Entered {
 public:
  Entered(std::set<const Element*>& all, const Element& element) : all_(all), element_(element) {
    if (all.size() == kDeepest) element.fail("elements refer to one another too deep");
    if (!all.insert(&element).second) element.fail("this refers to itself");
  }
  ~Entered() { all_.erase(&element_); }
  Entered(const Entered&) = delete;
  Entered& operator=(const Entered&) = delete;

 private:
  std::set<const Element*>& all_;
  const Element& element_;
};

Rgb Builder::color(const Element& object, std::string_view name, double otherwise) {
  const Element* const parameter = find(object, name);
  if (!parameter) return gray(otherwise);
  const Element& meant = document_.resolved(*parameter);
  if (meant.is("texture")) return mean(meant);
  if (const auto found = plain_color(meant)) return *found;
  assembly_.notes().add(
      fmt::format("spectra that are neither numbers nor pairs: {} {:g}", name, otherwise));
  return gray(otherwise);
}

Rgb Builder::mean(const Element& texture) {
  if (const auto known = means_.find(&texture); known != means_.end()) return known->second;
  const Entered entered(entered_, texture);
  return means_[&texture] = new_mean(texture);
}

Rgb Builder::new_mean(const Element& texture) {
  const std::string& type = texture.need("type");
  if (type == "bitmap") {
    const std::string file(text(texture, "filename"));
    return images_.mean_color_of(file, includes_, assembly_.notes());
  }
  if (type == "checkerboard") {
    assembly_.notes().add("textures: their mean color alone is kept");
    return (color(texture, "color0", 0.4) + color(texture, "color1", 0.2)) * 0.5;
  }
  assembly_.notes().changed(type, "a gray of 0.5 instead of that texture");
  return gray(0.5);
}

Builder::Finish Builder::finish_of(const Element& bsdf) {
  if (const auto known = finishes_.find(&bsdf); known != finishes_.end()) return known->second;
  const Entered entered(entered_, bsdf);
  Finish finish = new_finish(bsdf);
  const std::string_view id = bsdf.text("id");
  if (!id.empty()) finish.name = id;
  return finishes_[&bsdf] = finish;
}

Builder::Finish Builder::new_finish(const Element& bsdf) {
  const std::string& type = bsdf.need("type");
  Finish finish;
  finish.name = type;
  if (type == "twosided" || is_one_of(type, kAroundAnother)) {
    const Element* const inner = child(bsdf, "bsdf");
    if (!inner) bsdf.fail(fmt::format("{} needs a <bsdf> within", in_quotes(type)));
    finish = finish_of(*inner);
    if (type == "twosided") {
      finish.two_sided = true;
    } else {
      assembly_.notes().changed(type, "only the BSDF within");
    }
  } else if (type == "blendbsdf") {
    finish = blend(bsdf);
  } else if (type == "diffuse") {
    finish.reflectance = color(bsdf, "reflectance", 0.5);
  } else if (is_one_of(type, kCoated)) {
    finish.reflectance = color(bsdf, "diffuse_reflectance", 0.5);
    assembly_.notes().changed(type, "the diffuse part alone");
  } else if (is_one_of(type, kPrincipled)) {
    const double metal = luminance(color(bsdf, "metallic", 0));
    const double clear = luminance(color(bsdf, "spec_trans", 0));
    finish.reflectance = color(bsdf, "base_color", 0.5) *
                         (std::clamp(1 - metal, 0.0, 1.0) * std::clamp(1 - clear, 0.0, 1.0));
    assembly_.notes().changed(type, "the diffuse part alone");
  } else if (is_one_of(type, kBlack)) {
    finish.reflectance = {};
    assembly_.notes().changed(type, "black, as it mirrors alone");
  } else if (is_one_of(type, kClear)) {
    finish.reflectance = {};
    finish.clear = true;
    assembly_.notes().changed(type, "surfaces left out, light passes unhindered");
  } else {
    assembly_.notes().changed(type, "a gray that reflects 0.5");
  }
  return finish;
}

/// Two, mixed by `weight`: the part that the second has.
Builder::Finish Builder::blend(const Element& bsdf) {
  std::vector<Finish> two;
  for (const Element& element : bsdf.children) {
    const Element& meant = document_.resolved(element);
    if (meant.is("bsdf")) two.push_back(finish_of(meant));
  }
  if (two.size() != 2) bsdf.fail("'blendbsdf' needs two <bsdf> within");
  const double weight = std::clamp(luminance(color(bsdf, "weight", 0.5)), 0.0, 1.0);
  Finish finish = two[0];
  finish.name = "blendbsdf";
  finish.reflectance = two[0].reflectance * (1 - weight) + two[1].reflectance * weight;
  finish.two_sided = two[0].two_sided || two[1].two_sided;
  finish.clear = two[0].clear && two[1].clear;
  return finish;
}

}  // namespace isolux::mitsuba
