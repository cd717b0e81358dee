#include "isolux/formats/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "isolux/core/error.h"
#include "isolux/formats/gltf/reader.h"
#include "isolux/formats/mesh/reader.h"
#include "isolux/formats/mgf/mgf.h"
#include "isolux/formats/mitsuba/reader.h"
#include "isolux/formats/obj/reader.h"
#include "isolux/formats/openscad/reader.h"
#include "isolux/formats/pbrt/reader.h"
#include "isolux/formats/radiance/read_radiance.h"
#include "isolux/formats/rayshade/reader.h"
#include "isolux/scene/reader.h"
#include "isolux/scene/spelling.h"
#include "isolux/scene/writer.h"

namespace isolux {
namespace {

struct FormatReader {
  std::string_view name;
  std::vector<std::string_view> extensions;
  SceneFile (*read)(const std::filesystem::path& path);  ///< null for the native format
};

const std::vector<FormatReader>& format_readers() {
  static const std::vector<FormatReader> all{
      {"isolux", {".yaml", ".yml"}, nullptr},
      {"gltf", {".gltf", ".glb"}, read_gltf},
      {"mgf", {".mgf"}, read_mgf},
      {"mitsuba", {".xml"}, read_mitsuba},
      {"obj", {".obj"}, read_obj},
      {"openscad", {".csg"}, read_openscad},
      {"pbrt", {".pbrt"}, read_pbrt},
      {"ply", {".ply"}, read_ply},
      {"radiance", {".rad", ".rif"}, read_radiance},
      {"rayshade", {".ray"}, read_rayshade},
      {"stl", {".stl"}, read_stl},
  };
  return all;
}

const FormatReader& reader_for(const std::filesystem::path& path, const std::string& format) {
  const auto& readers = format_readers();
  if (!format.empty()) {
    const auto found = std::find_if(readers.begin(), readers.end(),
                                    [&](const FormatReader& r) { return r.name == format; });
    if (found != readers.end()) return *found;
    std::vector<std::string_view> names;
    for (const FormatReader& reader : readers) names.push_back(reader.name);
    throw InputError(
        fmt::format("unknown format {}: {}", in_quotes(format), suggestion(format, names)));
  }
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const FormatReader& reader : readers) {
    const auto& known = reader.extensions;
    if (std::find(known.begin(), known.end(), extension) != known.end()) return reader;
  }
  return readers.front();
}

}  // namespace

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const FormatReader& reader : format_readers()) names.emplace_back(reader.name);
  return names;
}

SceneFile load_scene_file(const std::filesystem::path& path, const std::string& format,
                          const ReadingCallback& progress) {
  const FormatReader& reader = reader_for(path, format);
  report_progress(progress, {"reading", 0});
  if (!reader.read) return {load_scene(path, progress), {}};
  SceneFile file = reader.read(path);
  report_progress(progress, {"converting", 0});
  // As it will be read from a saved solution: what can't be, had better be known now.
  const std::string native = write_scene(file.scene);
  file.scene = {};
  file.scene = read_scene(native, path.string() + " (converted)", progress);
  return file;
}

}  // namespace isolux
