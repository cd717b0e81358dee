#include "isolux/formats/mesh/reader.h"

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/formats/assembly.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/mesh/ply.h"
#include "isolux/formats/mesh/stl.h"

namespace isolux {
namespace {

SceneFile scene_of(std::vector<StlSolid> solids, const Cutting& cutting,
                   const std::filesystem::path& path) {
  const Look gray_surface{"gray", gray(0.5), {}, true};
  Assembly assembly(path.stem().string());
  assembly.notes().add("no material in the file: gray that reflects 0.5");
  assembly.notes().add("no unit of length in the file: metres");
  assembly.notes().add(cutting.uncertain, "face", "with sides that cross: cut as a fan");
  try {
    for (StlSolid& solid : solids) {
      const std::string name = solid.name.empty() ? path.stem().string() : solid.name;
      assembly.add(name, assembly.mesh(std::move(solid.soup), true), gray_surface);
    }
    return assembly.finish();
  } catch (const InputError& error) {
    throw InputError({path.string()}, error.what());
  }
}

}  // namespace

SceneFile read_ply(const std::filesystem::path& path) {
  Cutting cutting;
  TriangleSoup soup = parse_ply({path.string(), read_file(path, kLargestMainFile)}, cutting);
  return scene_of({{"", std::move(soup)}}, cutting, path);
}

SceneFile read_stl(const std::filesystem::path& path) {
  return scene_of(parse_stl({path.string(), read_file(path, kLargestMainFile)}), {}, path);
}

}  // namespace isolux
