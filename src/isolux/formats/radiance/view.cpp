#include "isolux/formats/radiance/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/formats/radiance/scanner.h"
#include "isolux/scene/spelling.h"

namespace isolux::radiance {

void read_view(const Statement& options, std::size_t first, Includes& includes, View& view) {
  std::size_t at = first;
  const auto numbers = [&](std::size_t count) {
    if (at + count >= options.size()) {
      options.fail(at, fmt::format("{} needs {} number{}", in_quotes(options.word(at)), count,
                                   count == 1 ? "" : "s"));
    }
    at += count;
    return at - count + 1;
  };
  const auto vector = [&] {
    const std::size_t i = numbers(3);
    return Vec3{options.number(i), options.number(i + 1), options.number(i + 2)};
  };
  for (; at < options.size(); ++at) {
    const std::string_view option = options.word(at);
    if (option.starts_with("-vt") && option.size() == 4) {
      view.type = option[3];
    } else if (option == "-vp") {
      view.eye = vector();
    } else if (option == "-vd") {
      view.direction = vector();
    } else if (option == "-vu") {
      view.up = vector();
    } else if (option == "-vh") {
      view.width = options.number(numbers(1));
    } else if (option == "-vv") {
      view.height = options.number(numbers(1));
    } else if (option == "-vs" || option == "-vl") {
      view.shifted |= options.number(numbers(1)) != 0;
    } else if (option == "-vf") {
      if (++at == options.size()) options.fail(at - 1, "'-vf' needs the name of a file");
      try {
        const SourceText file = includes.open(options.word(at));
        const std::string name = std::move(view.name);
        view = view_of_file(file, includes).value_or(View{});
        view.name = name;
      } catch (const InputError& error) {
        options.fail(at, error.what());
      }
      includes.close();
    }
  }
}

std::optional<View> view_of_file(const SourceText& source, Includes& includes) {
  std::optional<View> last;
  Scanner scanner(source);
  while (const auto line = scanner.line()) {
    bool views = false;
    for (std::size_t i = 1; i < line->size(); ++i) views |= line->word(i).starts_with("-v");
    if (!views) continue;
    last = View{};
    read_view(*line, 1, includes, *last);
  }
  return last;
}

std::optional<Camera> camera_of(const View& view) {
  const auto degrees = [](double angle) { return angle > 0.01 && angle < 179.9; };
  constexpr double kMostDistance = 1e9;
  if (view.type != 'v' || view.shifted || !degrees(view.width) || !degrees(view.height) ||
      !(length(view.eye) < kMostDistance)) {
    return std::nullopt;
  }
  const Vec3 direction = normalized(view.direction);
  if (!(length(cross(direction, normalized(view.up))) > 1e-6)) return std::nullopt;
  const auto half = [](double angle) { return std::tan(angle * std::numbers::pi / 360); };
  Camera camera;
  camera.name = view.name;
  camera.eye = view.eye;
  camera.look_at = view.eye + direction * std::max(1.0, 1e-6 * length(view.eye));
  camera.up = view.up;
  camera.fov = view.height;
  const double aspect = std::clamp(half(view.width) / half(view.height), 0.01, 100.0);
  camera.height = static_cast<int>(std::clamp(std::round(camera.width / aspect), 1.0, 32768.0));
  return camera;
}

}  // namespace isolux::radiance
