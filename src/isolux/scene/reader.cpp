#include "isolux/scene/reader.h"

#include <fmt/format.h>

#include <map>
#include <new>

#include "isolux/core/file.h"
#include "isolux/scene/length.h"
#include "isolux/scene/light_reader.h"
#include "isolux/scene/part_reader.h"
#include "isolux/scene/shape_reader.h"
#include "isolux/scene/sky_reader.h"
#include "isolux/scene/spelling.h"
#include "isolux/scene/value.h"

namespace isolux {
namespace {

constexpr std::size_t kLargestFile = std::size_t{256} << 20;  ///< bytes

using MaterialIndex = std::map<std::string, std::uint32_t, std::less<>>;

/// Before all else, since a later version may have other keys.
void check_version(const Value& root) {
  const std::optional<Value> version = root.find("isolux");
  if (!version) root.fail("not an isolux scene: write 'isolux: 1' on its first line");
  if (version->number() != 1) {
    version->fail("this version of the format is not known: only 'isolux: 1' is");
  }
}

Material read_material(const Value& name, const Value& value) {
  const Fields fields(value, {"reflectance"});
  return {name.text(), read_reflectance(fields.require("reflectance"))};
}

std::uint32_t find_material(const Value& value, const MaterialIndex& materials) {
  const std::string name = value.text();
  const auto found = materials.find(name);
  if (found != materials.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& [known, index] : materials) names.push_back(known);
  value.fail(fmt::format("unknown material {}: {}", in_quotes(name), suggestion(name, names)));
}

Sides read_sides(const Fields& fields, const Shape& shape) {
  const std::optional<Value> value = fields.find("sides");
  if (!value) return shape.solid() ? Sides::front : Sides::both;
  const Sides sides = value->choice({"front", "both"}) == 0 ? Sides::front : Sides::both;
  if (sides == Sides::both && shape.solid()) {
    value->fail("a solid has only its outer side: remove 'sides', or open the shape");
  }
  return sides;
}

/// An object, or several where its parts look different.
std::vector<Object> read_object(const Value& value, std::size_t number,
                                const MaterialIndex& materials, const ShapeLibrary& shapes) {
  const Fields fields(value, {"name", "shape", "material", "sides", "transform", "emission"});
  const ReadShape read = shapes.read(
      fields.require("shape"), [&](const Value& name) { return find_material(name, materials); });
  Object object;
  const std::optional<Value> name = fields.find("name");
  object.name = name ? name->text() : fmt::format("{} {}", read.kind, number);
  object.shape = transformed(read.shape, fields);
  object.material = find_material(fields.require("material"), materials);
  object.sides = read_sides(fields, *object.shape);
  if (const auto emission = fields.find("emission")) {
    object.exitance = read_emission(*emission, *object.shape);
  }
  try {
    return split_by_finish(object, read.faces);
  } catch (const InputError& error) {
    value.fail(error.what());
  }
}

Scene read_document(const YamlDocument& document, const ReadingCallback& progress) {
  ReadingContext context{document.file};
  const Value root(context, *document.root, "scene");
  check_version(root);
  const Fields fields(root, {"isolux", "name", "unit", "materials", "shapes", "objects", "lights",
                             "sky", "cameras"});
  Scene scene;
  if (const auto name = fields.find("name")) scene.name = name->text();
  if (const auto unit = fields.find("unit")) {
    scene.unit = length_units()[unit->choice(length_units())];
    context.metres_per_unit = *metres_per(scene.unit);
  }
  MaterialIndex materials;
  for (const auto& [name, value] : fields.require("materials").entries()) {
    materials.emplace(name.text(), static_cast<std::uint32_t>(scene.materials.size()));
    scene.materials.push_back(read_material(name, value));
  }
  ShapeLibrary shapes;
  if (const auto named = fields.find("shapes")) {
    for (const auto& [name, shape] : named->entries()) shapes.add(name, shape);
  }
  const Value objects = fields.require("objects");
  constexpr std::size_t kReportEvery = 256;
  const std::vector<Value> items = objects.items();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i % kReportEvery == 0) {
      report_progress(progress, {"making objects", double(i) / double(items.size())});
    }
    for (Object& part : read_object(items[i].labelled("object"), i + 1, materials, shapes)) {
      scene.objects.push_back(std::move(part));
    }
  }
  if (scene.objects.empty()) objects.fail("the scene is empty: give at least one object");
  if (const auto lights = fields.find("lights")) {
    for (const Value& light : lights->items()) {
      scene.sources.push_back(read_source(light.labelled("light"), scene.sources.size() + 1));
    }
  }
  if (const auto sky = fields.find("sky")) scene.sky = read_sky(*sky);
  if (const auto cameras = fields.find("cameras")) {
    for (const auto& [name, value] : cameras->entries()) {
      scene.cameras.push_back(read_camera(name, value));
    }
  }
  return scene;
}

}  // namespace

Scene read_scene(const std::string& text, const std::string& file,
                 const ReadingCallback& progress) {
  try {
    Scene scene = read_document(parse_yaml(text, file, progress), progress);
    scene.source = text;
    return scene;
  } catch (const std::bad_alloc&) {
    throw InputError({file}, "the scene needs more memory than there is: make it smaller");
  }
}

Scene load_scene(const std::filesystem::path& path, const ReadingCallback& progress) {
  return read_scene(read_file(path, kLargestFile), path.string(), progress);
}

}  // namespace isolux
