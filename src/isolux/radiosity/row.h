#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace isolux {

/// A cell of a row's grid that was divided into parts × parts cells.
struct DividedCell {
  std::uint16_t cell = 0;  ///< i + grid × j
  std::uint16_t parts = 2;

  std::size_t count() const { return std::size_t{parts} * parts; }
};
static_assert(sizeof(DividedCell) == 4);

/// Rays over a hemisphere, as they are sent out or as they landed: one for each cell of a square
/// of grid × grid cells, all of which weigh the same, then those of the cells that were divided,
/// one cell after the other. The one ray of a divided cell counts no more.
template <typename Ray>
struct Row {
  int grid = 0;  ///< cells a side, at most 256
  std::vector<DividedCell> divided;
  std::vector<Ray> rays;

  bool empty() const { return rays.empty(); }
  std::size_t cells() const { return static_cast<std::size_t>(grid) * std::size_t(grid); }
};

/// The mean of value(i), of ray i, over the hemisphere.
template <typename Ray, typename Value>
auto mean_over(const Row<Ray>& row, const Value& value) {
  auto sum = decltype(value(std::size_t{0})){};
  for (std::size_t i = 0; i < row.cells(); ++i) sum += value(i);
  std::size_t first = row.cells();
  for (const DividedCell& divided : row.divided) {
    auto part = decltype(sum){};
    for (std::size_t i = 0; i < divided.count(); ++i) part += value(first + i);
    sum += part / static_cast<double>(divided.count()) - value(divided.cell);
    first += divided.count();
  }
  return sum / static_cast<double>(row.cells());
}

/// The variance of the mean over a row, of whose rays these are the values: that of the cells that
/// are not divided, and that of the parts of the others.
double variance_of_mean(int grid, std::span<const DividedCell> divided,
                        std::span<const double> values);

}  // namespace isolux
