#include "isolux/formats/radiance/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "isolux/core/error.h"
#include "isolux/formats/default_camera.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/obj/geometry.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/reversed.h"
#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace {

using std::numbers::pi;

constexpr double kWidestSun = 10;          ///< degrees: what still is directional light
constexpr double kMostIlluminance = 1e15;  ///< lx

[[noreturn]] void unknown_type(const Primitive& p) {
  std::vector<std::string_view> known = modifier_types();
  known.insert(known.end(), surface_types().begin(), surface_types().end());
  known.insert(known.end(), {"source", "mesh", "instance"});
  p.head.fail(1,
              fmt::format("unknown type {}: {}", in_quotes(p.type()), suggestion(p.type(), known)));
}

}  // namespace

std::string Context::prefixed(std::string_view name) const {
  return clean_name(prefix + std::string(name));
}

Reader::Reader(const std::filesystem::path& file)
    : file_(file), includes_(file, Includes::Base::main_file) {
  result_.scene.name = file.stem().string();
}

void Reader::read(Scanner scanner, const Context& context) {
  while (const auto item = scanner.next()) {
    if (const auto* const command = std::get_if<Command>(&*item)) {
      run(*command, context);
    } else {
      add(std::get<Primitive>(*item), context);
    }
  }
}

void Reader::read_file(const Statement& s, std::size_t i, const Context& context) {
  SourceText source;
  try {
    source = includes_.open(s.word(i));
  } catch (const InputError& error) {
    s.fail(i, error.what());
  }
  read(Scanner(source), context);
  includes_.close();
}

void Reader::add(const Primitive& p, const Context& context) {
  if (is_modifier(p.type())) return materials_.define(p, context.maps.front());
  if (p.type() == "instance") return add_instance(p, context);
  if (p.type() == "mesh") return add_mesh(p, context);
  const auto& types = surface_types();
  const bool is_surface = std::find(types.begin(), types.end(), p.type()) != types.end();
  if (!is_surface && p.type() != "source") unknown_type(p);
  const std::string_view modifier =
      context.modifier ? std::string_view(*context.modifier) : p.modifier();
  if (!is_surface) return add_source(p, modifier, context);
  const Finish& finish = materials_.finish_of(modifier);
  const Surface surface = read_surface(p);
  try {
    add_surface(surface, p.name(), finish, context);
  } catch (const InputError& error) {
    p.head.fail(0, error.what());
  }
}

/// Counts surfaces, and what they are made of: whether they are kept or not, they take time.
void Reader::require_room(const Surface& surface, std::size_t places) {
  surfaces_ += places;
  if (surfaces_ > kMostObjects) {
    throw InputError(fmt::format("the scene has more than {} surfaces", kMostObjects));
  }
  triangles_ += surface.triangles;
  if (triangles_ > kMostTriangles) {
    throw InputError(
        fmt::format("the meshes of this scene have more than {} triangles", kMostTriangles));
  }
  corner_pairs_ +=
      static_cast<double>(surface.corners) * static_cast<double>(surface.corners * places);
  if (corner_pairs_ > kMostCornerPairs) {
    throw InputError(
        "the polygons of this scene have too many corners; cut them into smaller ones");
  }
}

void Reader::add_surface(const Surface& surface, std::string_view word, const Finish& finish,
                         const Context& context) {
  require_room(surface, context.maps.size());
  if (!finish.solid) {
    ++left_out_;
    return;
  }
  if (!surface.flat) {
    notes_.add("polygons with corners off their plane: cut into flat triangles");
  }
  const bool emits = max_channel(finish.exitance) > 0;
  const std::uint32_t material = material_number(finish);
  const std::string name = context.prefixed(word);
  const PlacedShape shape = context.maps.size() > 1 ? shared(surface.shape) : surface.shape;
  for (const Affine& map : context.maps) {
    Object object;
    object.shape = shape(map);
    if (!object.shape) {
      notes_.add("surfaces without area: left out");
      continue;
    }
    if (context.turned_over) object.shape = std::make_shared<Reversed>(std::move(object.shape));
    object.name = object_names_.next(name);
    object.material = material;
    object.exitance = finish.exitance;
    object.sides = emits || object.shape->solid() ? Sides::front : Sides::both;
    result_.scene.objects.push_back(std::move(object));
  }
}

std::uint32_t Reader::material_number(const Finish& finish) {
  const Rgb& r = finish.reflectance;
  auto& materials = result_.scene.materials;
  const auto [number, is_new] =
      material_numbers_.try_emplace(fmt::format("{} {} {} {}", finish.name, r.r, r.g, r.b),
                                    static_cast<std::uint32_t>(materials.size()));
  if (is_new) materials.push_back({material_names_.next(finish.name), r});
  return number->second;
}

void Reader::add_source(const Primitive& p, std::string_view modifier, const Context& context) {
  p.expect_numbers(4, 4, "x y z angle");
  const Vec3 toward{p.number(0), p.number(1), p.number(2)};
  const double angle = p.number(3);
  if (!(length(normalized(toward)) > 0)) p.numbers.fail(1, "the direction must not be zero");
  if (angle < 0 || angle > 360) p.numbers.fail(4, "the angle must lie between 0 and 360 degrees");
  constexpr std::string_view kDark = "where it gives no light";
  try {
    require_room({}, context.maps.size());
  } catch (const InputError& error) {
    p.head.fail(0, error.what());
  }
  const auto placed = [&](const Affine& map) { return normalized(map.vector(normalized(toward))); };
  if (angle > kWidestSun) {
    const SourceLight light = materials_.source_light_of(modifier);
    // A black sky still says where up is.
    if (!(max_channel(light.luminance) > 0) && !light.pattern.sky) {
      return notes_.left_out("source", kDark);
    }
    for (const Affine& map : context.maps) skies_.add(placed(map), angle, light, p.head.location());
    return;
  }
  Source source;
  source.kind = Source::Kind::directional;
  source.intensity = materials_.finish_of(modifier).exitance * (solid_angle(angle) / pi);
  if (!(max_channel(source.intensity) > 0)) return notes_.left_out("source", kDark);
  if (!(max_channel(source.intensity) <= kMostIlluminance)) {
    p.numbers.fail(0, fmt::format("more than {:g} lx would come from here", kMostIlluminance));
  }
  for (const Affine& map : context.maps) {
    source.name = object_names_.next(context.prefixed(p.name()));
    source.direction = -placed(map);
    result_.scene.sources.push_back(source);
  }
}

std::vector<Affine> Reader::maps_of(const Primitive& p, const Context& context) {
  std::size_t at = 2;
  std::vector<Affine> maps = placed(p.strings, at, context.maps);
  if (at < p.strings.size()) {
    p.strings.fail(at, fmt::format("{} is no transform", in_quotes(p.strings.word(at))));
  }
  return maps;
}

std::optional<SourceText> Reader::open_beside(const Primitive& p, std::string_view extension) {
  const std::filesystem::path named(p.strings.word(1));
  try {
    return includes_.open(std::filesystem::path(named).replace_extension(extension).string());
  } catch (const InputError&) {
    notes_.left_out(p.type() == "mesh" ? "mesh" : "instance",
                    "such files are not read, and what they are made from (.obj of a mesh, .rad of "
                    "an octree) does not stand beside");
    return std::nullopt;
  }
}

/// Reads the description that stands beside an octree, with its extension .rad.
void Reader::add_instance(const Primitive& p, const Context& context) {
  if (p.strings.size() < 2) p.strings.fail(0, "an instance has the name of an octree");
  Context inner;
  inner.maps = maps_of(p, context);
  inner.turned_over = context.turned_over;
  inner.prefix = context.prefixed(p.name()) + '.';
  inner.modifier = context.modifier;
  if (!inner.modifier && p.modifier() != "void") inner.modifier = std::string(p.modifier());
  const std::optional<SourceText> source = open_beside(p, ".rad");
  if (!source) return;
  read(Scanner(*source), inner);
  includes_.close();
}

/// Reads the polygons that stand beside a mesh, with its extension .obj.
void Reader::add_mesh(const Primitive& p, const Context& context) {
  if (p.strings.size() < 2) p.strings.fail(0, "a mesh has the name of a file");
  const std::string modifier = context.modifier.value_or(std::string(p.modifier()));
  if (modifier == "void") {
    return notes_.left_out("mesh", "without a modifier, the materials in its file are not read");
  }
  const Finish& finish = materials_.finish_of(modifier);
  Context inner = context;
  inner.maps = maps_of(p, context);
  const bool two_sided = !(max_channel(finish.exitance) > 0);
  const std::string key = fmt::format("{} {}", two_sided, p.strings.word(1));
  auto mesh = meshes_.find(key);
  TriangleSoup soup;
  if (mesh == meshes_.end()) {
    const std::optional<SourceText> source = open_beside(p, ".obj");
    if (!source) return;
    soup = parse_obj(*source, cutting_);
    includes_.close();
  }
  try {
    if (mesh == meshes_.end()) {
      mesh = meshes_.emplace(key, mesh_surface(std::move(soup), two_sided)).first;
    }
    add_surface(mesh->second, p.name(), finish, inner);
  } catch (const InputError& error) {
    p.head.fail(0, error.what());
  }
}

Surface Reader::mesh_surface(TriangleSoup soup, bool two_sided) {
  weld(soup);
  triangles_ += soup.triangles.size();
  require_room({}, 0);
  if (soup.triangles.empty()) return {[](const Affine&) { return nullptr; }};
  const auto mesh = mesh_of(std::move(soup), two_sided);
  return {[mesh](const Affine& map) -> std::shared_ptr<const Shape> {
    const bool moved = map.linear != Affine{}.linear || map.translation != Vec3{};
    return moved ? std::make_shared<Instance>(mesh, map) : mesh;
  }};
}

SceneFile Reader::finish() {
  Scene& scene = result_.scene;
  if (scene.objects.empty()) {
    throw InputError(
        left_out_ == 0 ? "the scene has no surfaces"
                       : fmt::format("none of the scene's {} surfaces reflects or shines, so that "
                                     "all are left out",
                                     left_out_));
  }
  scene.sky = skies_.sky();
  if (scene.cameras.empty() || !has_own_view_) {
    scene.cameras.insert(scene.cameras.begin(), default_camera(scene));
  }
  materials_.note_undefined();
  result_.notes = notes_.lines();
  return std::move(result_);
}

}  // namespace isolux::radiance
