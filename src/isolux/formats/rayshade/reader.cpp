#include "isolux/formats/rayshade/reader.h"

#include <new>

#include "isolux/formats/rayshade/builder.h"
#include "isolux/formats/rayshade/parser.h"

namespace isolux {
namespace {

SceneFile read(const std::filesystem::path& path) {
  using namespace rayshade;
  const rayshade::SourceText source = preprocess(path);
  Notes notes;
  Model model = Parser(source, notes).parse();
  if (model.lights.empty()) {
    notes.add("no light in the file: the directional light of Rayshade's default stands in");
    Light light;
    light.kind = Light::Kind::directional;
    light.place.file = &source.files.front();
    light.intensity = gray(1);
    light.direction = {1, -1, 1};
    model.lights.push_back(light);
  }
  SceneFile file;
  file.scene = build_scene(model, notes);
  file.scene.name = path.stem().string();
  file.notes = notes.lines();
  return file;
}

}  // namespace

SceneFile read_rayshade(const std::filesystem::path& path) {
  try {
    return read(path);
  } catch (const std::bad_alloc&) {
    throw InputError({path.string()}, "the scene needs more memory than there is: make it smaller");
  }
}

}  // namespace isolux
