#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <memory>
#include <string>

#include "commands.h"
#include "isolux/core/error.h"
#include "isolux/image/exr.h"
#include "isolux/image/mesh_picture.h"
#include "isolux/image/png.h"
#include "isolux/image/resample.h"
#include "isolux/image/tone_map.h"
#include "isolux/solution/solution.h"
#include "output.h"

namespace isolux {
namespace {

struct Size {
  int width = 0;  ///< pixels; 0 where the camera's is meant
  int height = 0;
};

struct Arguments {
  std::filesystem::path solution, output;
  std::string camera;
  Size size;
  bool mesh = false;
  bool direct = false;
};

Size parse_size(const std::string& text) {
  constexpr int kMost = 32768;
  Size size;
  const char* const end = text.data() + text.size();
  const auto [cross, bad_width] = std::from_chars(text.data(), end, size.width);
  const bool crossed = bad_width == std::errc() && cross != end && *cross == 'x';
  const auto [stop, bad_height] = std::from_chars(crossed ? cross + 1 : end, end, size.height);
  const bool good = crossed && bad_height == std::errc() && stop == end && size.width >= 1 &&
                    size.width <= kMost && size.height >= 1 && size.height <= kMost;
  if (!good) {
    throw CLI::ValidationError(
        "--size",
        fmt::format("'{}' must be WIDTHxHEIGHT in pixels, such as 800x600, at most {} each", text,
                    kMost));
  }
  return size;
}

void run(const Arguments& a) {
  check_output(a.output, {".png", ".exr"});
  const bool exr = a.output.extension() == ".exr";
  if (exr && a.mesh) {
    throw InputError({a.output.string()}, "a picture of the mesh has no luminances: write a .png");
  }
  const Solution solution = load_solution(a.solution);
  Camera camera = solution.scene.camera(a.camera);
  if (a.size.width > 0) {
    camera.width = a.size.width;
    camera.height = a.size.height;
  }
  if (a.mesh) {
    write_png(mesh_picture(solution, camera), a.output);
    return;
  }
  RenderOptions options;
  options.direct = a.direct;
  const Picture picture = render(solution, camera, options).picture;
  if (exr) {
    write_exr(picture, a.output);
  } else {
    write_png(tone_map(picture), a.output);
  }
}

}  // namespace

void add_render(CLI::App& program) {
  const auto a = std::make_shared<Arguments>();
  CLI::App& command =
      *program.add_subcommand("render", "Solution to picture: of its light, or of its mesh");
  command.add_option("FILE.glb", a->solution, "the solution")->required()->option_text(" ");
  command.add_option("-o,--output", a->output, "the picture: .exr in cd/m², .png for the eye")
      ->required()
      ->option_text("IMAGE");
  command.add_option("--camera", a->camera, "of the scene [the first]")->option_text("NAME");
  command
      .add_option_function<std::string>(
          "--size", [a](const std::string& text) { a->size = parse_size(text); },
          "in pixels [the camera's]")
      ->option_text("WxH");
  CLI::Option* const mesh = command.add_flag("--mesh", a->mesh, "the mesh instead, as .png");
  command.add_flag("--direct", a->direct, "the light of lights anew in every pixel")
      ->excludes(mesh);
  command.callback([a] { run(*a); });
}

}  // namespace isolux
