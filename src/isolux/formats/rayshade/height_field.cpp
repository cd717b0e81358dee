#include "isolux/formats/rayshade/height_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "isolux/core/error.h"
#include "isolux/geometry/height_field.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux::rayshade {
namespace {

constexpr std::uint32_t kLargestSide = 2048;
constexpr double kUnset = -1000;

std::uint32_t word_at(const std::string& bytes, std::size_t at, bool big_end_first) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[at + i]);
    word |= std::uint32_t{byte} << (8 * (big_end_first ? 3 - i : i));
  }
  return word;
}

/// The triangles between the places that are there, cut as those of a HeightField.
std::shared_ptr<const Shape> mesh_with_gaps(const std::vector<std::vector<double>>& heights) {
  const auto side = static_cast<std::uint32_t>(heights.size());
  const double step = 1.0 / (side - 1);
  TriangleSoup soup;
  std::vector<std::uint32_t> index(std::size_t{side} * side, UINT32_MAX);
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const double height = heights[i / side][i % side];
    if (height <= kUnset) continue;
    index[i] = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back({i % side * step, i / side * step, height});
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (std::max({index[a], index[b], index[c]}) == UINT32_MAX) return;
    soup.triangles.push_back({index[a], index[b], index[c]});
  };
  for (std::uint32_t y = 0; y + 1 < side; ++y) {
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t i = y * side + x;
      add(i, i + 1, i + side);
      add(i + 1, i + side + 1, i + side);
    }
  }
  if (soup.triangles.empty()) throw InputError("the height field has no triangle");
  return std::make_shared<TriangleMesh>(std::move(soup.points), std::move(soup.triangles));
}

}  // namespace

std::shared_ptr<const Shape> height_field(const std::string& bytes) {
  std::uint32_t side = 0;
  bool big_end_first = false;
  for (const bool big : {false, true}) {
    const std::uint32_t n = bytes.size() >= 4 ? word_at(bytes, 0, big) : 0;
    if (n < 2 || n > kLargestSide || bytes.size() != 4 + 4 * std::size_t{n} * n) continue;
    side = n, big_end_first = big;
  }
  if (side == 0) {
    throw InputError(
        fmt::format("it is no height field: a count from 2 to {} and that many rows of as many "
                    "heights, 4 bytes each",
                    kLargestSide));
  }
  std::vector<std::vector<double>> heights(side, std::vector<double>(side));
  bool has_gaps = false;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const auto height =
        double{std::bit_cast<float>(word_at(bytes, 4 + 4 * std::size_t{i}, big_end_first))};
    if (!std::isfinite(height)) throw InputError("a height is no finite number");
    has_gaps |= height <= kUnset;
    heights[i / side][i % side] = height;
  }
  if (has_gaps) return mesh_with_gaps(heights);
  return std::make_shared<HeightField>(Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, std::move(heights));
}

}  // namespace isolux::rayshade
