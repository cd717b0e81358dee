#include "isolux/formats/mgf/mgf.h"

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/mgf/reader.h"

namespace isolux {

SceneFile parse_mgf(const std::string& text, const std::filesystem::path& file) {
  const SourceText source{file.string(), text};
  mgf::Reader reader(file);
  reader.read(source);
  try {
    return reader.finish();
  } catch (const InputError& error) {
    throw InputError({source.file, 1, 1}, error.what());
  }
}

SceneFile read_mgf(const std::filesystem::path& path) {
  return parse_mgf(read_file(path, kLargestMainFile), path);
}

}  // namespace isolux
