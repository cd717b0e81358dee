#include "isolux/formats/radiance/read_radiance.h"

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/radiance/reader.h"

namespace isolux {

SceneFile parse_radiance(const std::string& text, const std::filesystem::path& file) {
  const SourceText source{file.string(), text};
  radiance::Reader reader(file);
  if (file.extension() == ".rif") {
    reader.read_project(source);
  } else {
    reader.read(source);
    reader.add_view_files();
  }
  try {
    return reader.finish();
  } catch (const InputError& error) {
    throw InputError({source.file, 1, 1}, error.what());
  }
}

SceneFile read_radiance(const std::filesystem::path& path) {
  return parse_radiance(read_file(path, kLargestMainFile), path);
}

}  // namespace isolux
