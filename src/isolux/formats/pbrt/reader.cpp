#include "isolux/formats/pbrt/reader.h"

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/pbrt/directives.h"

namespace isolux {

SceneFile read_pbrt(const std::filesystem::path& path) {
  const SourceText source{path.string(), read_file(path, kLargestMainFile)};
  pbrt::Directives directives(path);
  directives.read(source);
  try {
    return directives.finish();
  } catch (const InputError& error) {
    throw InputError({source.file}, error.what());
  }
}

}  // namespace isolux
