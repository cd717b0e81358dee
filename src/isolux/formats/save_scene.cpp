#include "isolux/formats/save_scene.h"

#include <fmt/format.h>

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/formats/mgf/write_mgf.h"
#include "isolux/formats/radiance/write_radiance.h"
#include "isolux/scene/spelling.h"
#include "isolux/scene/writer.h"

namespace isolux {
namespace {

struct FormatWriter {
  std::string_view extension;
  WrittenScene (*write)(const Scene& scene);
};

WrittenScene write_native(const Scene& scene) { return {write_scene(scene), {}}; }

constexpr FormatWriter kWriters[] = {
    {".yaml", write_native}, {".yml", write_native}, {".mgf", write_mgf}, {".rad", write_radiance}};

}  // namespace

std::vector<std::string> save_scene(const Scene& scene, const std::filesystem::path& path) {
  std::vector<std::string_view> known;
  for (const FormatWriter& writer : kWriters) {
    if (path.extension() == writer.extension) {
      WrittenScene written = writer.write(scene);
      write_file(path, written.text);
      return std::move(written.notes);
    }
    known.push_back(writer.extension);
  }
  throw InputError({path.string()},
                   fmt::format("no format has that extension: use one of {}", enumerated(known)));
}

}  // namespace isolux
