#include "isolux/formats/transform.h"

#include <fmt/format.h>

#include <numbers>

#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

Affine power(Affine map, int exponent) {
  Affine result;
  for (; exponent > 0; exponent /= 2, map = map * map) {
    if (exponent % 2) result = result * map;
  }
  return result;
}

/// Reads one step; `at`, the word of its flag, moves to the flag after it.
Affine read_step(const Statement& s, std::size_t& at) {
  const std::size_t flag = at++;
  const std::string_view name = s.word(flag);
  const auto numbers = [&](std::size_t count) {
    if (at + count > s.size()) {
      s.fail(flag,
             fmt::format("{} needs {} number{}", in_quotes(name), count, count == 1 ? "" : "s"));
    }
    at += count;
    return at - count;
  };
  constexpr Vec3 kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::size_t axis = name.empty() ? 0 : static_cast<std::size_t>(name.back() - 'x');
  if (name == "-t") {
    const std::size_t i = numbers(3);
    return Affine::translate({s.number(i), s.number(i + 1), s.number(i + 2)});
  }
  if (name == "-rx" || name == "-ry" || name == "-rz") {
    return Affine::rotate(kAxes[axis], s.number(numbers(1)) * std::numbers::pi / 180);
  }
  if (name == "-mx" || name == "-my" || name == "-mz") {
    return Affine::scale(Vec3{1, 1, 1} - kAxes[axis] * 2);
  }
  if (name == "-s" || name == "-sx" || name == "-sy" || name == "-sz") {
    const std::size_t i = numbers(1);
    const double factor = s.number(i);
    if (factor == 0) s.fail(i, "a factor of 0 flattens everything; use another");
    if (name == "-s") return Affine::scale(Vec3{1, 1, 1} * factor);
    return Affine::scale(Vec3{1, 1, 1} + kAxes[axis] * (factor - 1));
  }
  s.fail(flag, fmt::format("unknown transform {}: {}", in_quotes(name),
                           suggestion(name, {"-t", "-rx", "-ry", "-rz", "-s", "-sx", "-sy", "-sz",
                                             "-mx", "-my", "-mz", "-i", "-a"})));
}

}  // namespace

std::vector<Affine> read_transform(const Statement& s, std::size_t& at, std::size_t most) {
  // Steps act one after the other, from the left; those behind -i or -a, up to the next, together.
  std::vector<Affine> maps(1);
  const auto more = [&] { return at < s.size() && s.word(at).starts_with('-'); };
  while (more()) {
    const std::size_t opening = at;
    const bool array = s.word(at) == "-a", repeat = s.word(at) == "-i";
    int times = 1;
    if (array || repeat) {
      if (at + 1 == s.size()) s.fail(at, fmt::format("{} needs a count", in_quotes(s.word(at))));
      times = s.integer(at + 1, array ? 1 : 0, 1'000'000);
      at += 2;
    }
    Affine group;
    while (more() && s.word(at) != "-a" && s.word(at) != "-i") {
      group = read_step(s, at) * group;
    }
    if (!array) {
      for (Affine& map : maps) map = power(group, times) * map;
      continue;
    }
    const std::size_t before = maps.size();
    if (before * static_cast<std::size_t>(times) > most) {
      s.fail(opening, "the arrays of this scene have too many instances; use fewer");
    }
    for (int i = 1; i < times; ++i) {
      for (std::size_t k = 0; k < before; ++k) maps.push_back(group * maps[maps.size() - before]);
    }
  }
  for (const Affine& map : maps) {
    if (!is_finite(map.translation) || !map.inverse()) {
      s.fail(0, "the transform has numbers too large or too small to be undone");
    }
  }
  return maps;
}

}  // namespace isolux
