#include "isolux/formats/mgf/reader.h"

#include <fmt/format.h>

#include <utility>

#include "isolux/core/error.h"
#include "isolux/formats/colorimetry.h"
#include "isolux/formats/default_camera.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/statement_reader.h"
#include "isolux/formats/transform.h"
#include "isolux/geometry/require.h"

namespace isolux::mgf {
namespace {

constexpr std::size_t kDeepestObjects = 32;

}  // namespace

const std::map<std::string_view, Reader::Action> Reader::kActions = {
    {"v", &Reader::select_vertex},       {"p", &Reader::read_point},
    {"n", &Reader::read_normal},         {"c", &Reader::select_color},
    {"cxy", &Reader::read_chromaticity}, {"cspec", &Reader::read_spectrum},
    {"cct", &Reader::read_black_body},   {"cmix", &Reader::read_mix},
    {"m", &Reader::select_material},     {"sides", &Reader::read_sides},
    {"rd", &Reader::read_fraction},      {"td", &Reader::read_fraction},
    {"ed", &Reader::read_fraction},      {"rs", &Reader::read_fraction},
    {"ts", &Reader::read_fraction},      {"ir", &Reader::read_refraction},
    {"o", &Reader::read_object},         {"xf", &Reader::read_transform_entity},
    {"i", &Reader::read_include},        {"ies", &Reader::skip_luminaire},
};

Reader::Reader(const std::filesystem::path& file) : includes_(file) {
  result_.scene.name = file.stem().string();
}

void Reader::read(const SourceText& source) {
  const std::size_t outer_names = std::exchange(own_names_, names_.size());
  const std::size_t outer_transforms = std::exchange(own_transforms_, transforms_.size());
  StatementReader statements(source);
  while (const auto s = statements.next()) read(*s);
  if (transforms_.size() > own_transforms_) {
    throw InputError(transforms_.back().begin, "this transform is not ended in its file; add xf");
  }
  names_.resize(own_names_);
  own_names_ = outer_names;
  own_transforms_ = outer_transforms;
}

void Reader::read(const Statement& s) {
  if (is_surface(s.word(0))) return add_surface(s);
  const auto action = kActions.find(s.word(0));
  if (action != kActions.end()) return (this->*action->second)(s);
  findings_.unknown.insert(clean_name(s.word(0)));
}

SceneFile Reader::finish() {
  if (result_.scene.objects.empty()) throw InputError("the scene has no surfaces");
  result_.scene.cameras.push_back(default_camera(result_.scene));
  result_.notes = notes_of(findings_);
  return std::move(result_);
}

void Reader::read_point(const Statement& s) {
  s.expect_arguments(3, 3, "p x y z");
  const Vec3 point{s.number(1), s.number(2), s.number(3)};
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(point[axis]) <= kLongestLength) continue;
    s.fail(axis + 1, fmt::format("must lie between -{0:g} and {0:g}", kLongestLength));
  }
  vertices_.current().point = point;
}

void Reader::read_normal(const Statement& s) {
  s.expect_arguments(3, 3, "n dx dy dz");
  vertices_.current().normal = {s.number(1), s.number(2), s.number(3)};
}

void Reader::read_chromaticity(const Statement& s) {
  s.expect_arguments(2, 2, "cxy x y");
  const double x = s.number_of_at_least_0(1), y = s.number_of_at_least_0(2);
  if (y < 1e-6) s.fail(2, "y must be more than 0, or the color has no luminance");
  if (x + y > 1 + 1e-6) s.fail(1, fmt::format("x + y must be at most 1, but is {}", x + y));
  const Vec3 xyz = xyz_of_chromaticity(x, y);
  colors_.current() = {xyz.x, xyz.z};
}

void Reader::read_spectrum(const Statement& s) {
  s.expect_arguments(4, Statement::kAnyNumber, "cspec l_min l_max v1 v2 ...");
  constexpr double kLongest = 1e5;  // nm
  const double first = s.number_of_at_least_0(1), last = s.number(2);
  if (!(first < last && last <= kLongest)) {
    s.fail(2, "the last wavelength must be longer than the first, both in nm");
  }
  std::vector<double> values;
  for (std::size_t i = 3; i < s.size(); ++i) values.push_back(s.number(i));
  const Vec3 xyz = xyz_of_spectrum(first, last, values);
  if (xyz.y > 0 && is_finite(xyz / xyz.y)) {
    colors_.current() = {xyz.x / xyz.y, xyz.z / xyz.y};
  } else {
    colors_.current() = {};
    ++findings_.dark_spectra;
  }
}

void Reader::read_black_body(const Statement& s) {
  s.expect_arguments(1, 1, "cct temperature");
  const double temperature = s.number(1);
  if (!(temperature >= 100 && temperature <= 1e6)) {
    s.fail(1, fmt::format("the temperature must lie between 100 and 1000000 K, but is {}",
                          temperature));
  }
  const Vec3 xyz = xyz_of_black_body(temperature);
  colors_.current() = {xyz.x, xyz.z};
}

void Reader::read_mix(const Statement& s) {
  s.expect_arguments(2, Statement::kAnyNumber, "cmix w1 c1 w2 c2 ...");
  if (s.size() % 2 == 0) s.fail(s.size() - 1, "this weight lacks a color");
  Vec3 sum;
  for (std::size_t i = 1; i < s.size(); i += 2) {
    sum += colors_.named(s, i + 1).xyz() * s.number(i);
  }
  if (!(sum.y > 0) || !is_finite(sum / sum.y)) s.fail(1, "the weights must have a positive sum");
  colors_.current() = {sum.x / sum.y, sum.z / sum.y};
}

void Reader::read_sides(const Statement& s) {
  s.expect_arguments(1, 1, "sides 1 or sides 2");
  materials_.current().sides = s.integer(1, 1, 2);
}

void Reader::read_fraction(const Statement& s) {
  const std::string_view what = s.word(0);
  const bool rough = what == "rs" || what == "ts";
  s.expect_arguments(rough ? 2 : 1, rough ? 2 : 1,
                     rough ? "a fraction and a roughness" : "a single value");
  const double value = s.number_of_at_least_0(1);
  if (rough) s.number_of_at_least_0(2);
  Material& material = materials_.current();
  if (what == "rd") {
    material.diffuse = value;
    material.diffuse_color = colors_.current();
  } else if (what == "ed") {
    if (value > kMostExitance) s.fail(1, fmt::format("must be at most {:g} lm/m²", kMostExitance));
    material.emittance = value;
    material.emittance_color = colors_.current();
  } else if (what == "td") {
    material.diffuse_transmitted = value;
  } else if (what == "rs") {
    material.specular = value;
  } else {
    material.specular_transmitted = value;
  }
}

void Reader::read_refraction(const Statement& s) {
  s.expect_arguments(2, 2, "ir n_real n_imag");
  materials_.current().refracts = s.number(1) != 1 || s.number(2) != 0;
}

void Reader::read_object(const Statement& s) {
  s.expect_arguments(0, 1, "o [name]");
  if (s.size() == 1) {
    if (names_.size() == own_names_) s.fail(0, "no object is open in this file");
    names_.pop_back();
    return;
  }
  if (names_.size() == kDeepestObjects) {
    s.fail(0, fmt::format("objects (o) nest more than {} deep", kDeepestObjects));
  }
  const std::string name = clean_name(s.word(1));
  names_.push_back(names_.empty() ? name : names_.back() + '/' + name);
}

void Reader::begin_transform(const Statement& s, std::size_t first) {
  const std::vector<Affine> outer =
      transforms_.empty() ? std::vector<Affine>(1) : transforms_.back().maps;
  const std::vector<Affine> inner = read_transform(s, first, kMostMaps / outer.size());
  if (first < s.size())
    s.fail(first,
           fmt::format("{} is no transform: write xf -t 1 0 0 ...", in_quotes(s.word(first))));
  maps_made_ += outer.size() * inner.size();
  if (maps_made_ > kMostMaps) {
    s.fail(0, "the arrays of this scene have too many instances; use fewer");
  }
  Transform transform{s.location(), {}};
  transform.maps.reserve(outer.size() * inner.size());
  for (const Affine& map : outer) {
    for (const Affine& local : inner) transform.maps.push_back(map * local);
  }
  transforms_.push_back(std::move(transform));
}

void Reader::read_transform_entity(const Statement& s) {
  if (s.size() > 1) return begin_transform(s, 1);
  if (transforms_.size() == own_transforms_) s.fail(0, "no transform is open in this file");
  transforms_.pop_back();
}

void Reader::read_include(const Statement& s) {
  s.expect_arguments(1, Statement::kAnyNumber, "i file [transform]");
  SourceText source;
  try {
    source = includes_.open(s.word(1));
  } catch (const InputError& error) {
    s.fail(1, error.what());
  }
  if (s.size() > 2) begin_transform(s, 2);
  read(source);
  if (s.size() > 2) transforms_.pop_back();
  includes_.close();
}

void Reader::skip_luminaire(const Statement& s) {
  s.expect_arguments(1, Statement::kAnyNumber, "ies file [transform]");
  ++findings_.luminaires;
}

std::string Reader::next_name(const Statement& s) {
  return object_names_.next(names_.empty() ? std::string(s.word(0)) : names_.back());
}

const Reader::UsedMaterial& Reader::current_material() {
  const Material& material = materials_.current();
  const auto [used, is_new] =
      used_materials_.try_emplace({materials_.current_name(), material}, UsedMaterial{});
  if (!is_new) return used->second;

  const auto differs = [](const Rgb& a, const Rgb& b) {
    const Rgb d = a - b;
    return std::max(max_channel(d), -min_channel(d)) > 1e-9 * max_channel(a);
  };
  const double diffuse = std::min(material.diffuse, kMostReflectance);
  const Rgb reflected = rec709(material.diffuse_color.xyz()) * diffuse;
  const Rgb reflectance = paled_into_range(reflected, kMostReflectance);
  const Rgb emitted = rec709(material.emittance_color.xyz()) * material.emittance;
  used->second.exitance = paled_into_range(emitted, std::numeric_limits<double>::infinity());

  findings_.specular += material.specular > 0;
  findings_.transmitting += material.diffuse_transmitted > 0 || material.specular_transmitted > 0;
  findings_.refracting += material.refracts;
  findings_.clamped += material.diffuse > diffuse;
  findings_.paled += differs(reflected, reflectance) || differs(emitted, used->second.exitance);

  auto& materials = result_.scene.materials;
  const std::string name = clean_name(materials_.current_name(), "unnamed");
  const auto [number, is_other] =
      material_numbers_.try_emplace({name, reflectance.r, reflectance.g, reflectance.b},
                                    static_cast<std::uint32_t>(materials.size()));
  if (is_other) materials.push_back({material_names_.next(name), reflectance});
  used->second.number = number->second;
  return used->second;
}

void Reader::add_surface(const Statement& s) {
  const Surface surface = read_surface(s, vertices_);
  const std::vector<Affine> here(1);
  const std::vector<Affine>& maps = transforms_.empty() ? here : transforms_.back().maps;
  auto& objects = result_.scene.objects;
  if (objects.size() + maps.size() > kMostObjects) {
    s.fail(0, fmt::format("the scene has more than {} surfaces", kMostObjects));
  }
  const auto corners = static_cast<double>(surface.corners);
  corner_pairs_ += corners * corners * static_cast<double>(maps.size());
  if (corner_pairs_ > kMostCornerPairs) {
    s.fail(0, "the faces of this scene have too many corners; cut them into smaller ones");
  }
  findings_.folded += !surface.flat;
  findings_.smoothed += surface.smoothed;
  const UsedMaterial& material = current_material();
  const bool emits = material.exitance != Rgb{};
  try {
    const PlacedShape shape = maps.size() > 1 ? shared(surface.shape) : surface.shape;
    for (const Affine& map : maps) {
      Object object;
      object.shape = shape(map);
      if (!object.shape) {
        ++findings_.empty;
        continue;
      }
      object.name = next_name(s);
      object.material = material.number;
      object.exitance = material.exitance;
      const bool open_on_both = materials_.current().sides == 2 && !object.shape->solid();
      object.sides = open_on_both && !emits ? Sides::both : Sides::front;
      findings_.two_sided_lights += emits && open_on_both;
      objects.push_back(std::move(object));
    }
  } catch (const InputError& error) {
    s.fail(0, error.what());
  }
}

}  // namespace isolux::mgf
