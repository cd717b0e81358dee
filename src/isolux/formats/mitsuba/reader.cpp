#include "isolux/formats/mitsuba/reader.h"

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/mitsuba/builder.h"

namespace isolux {

SceneFile read_mitsuba(const std::filesystem::path& path) {
  const SourceText source{path.string(), read_file(path, kLargestMainFile)};
  mitsuba::Builder builder(source, path);
  builder.read();
  try {
    return builder.finish();
  } catch (const InputError& error) {
    throw InputError({source.file}, error.what());
  }
}

}  // namespace isolux
