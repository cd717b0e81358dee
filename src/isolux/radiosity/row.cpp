#include "isolux/radiosity/row.h"

#include <algorithm>

namespace isolux {
namespace {

/// The mean over all cells of the variance of one jittered point in the cell, from the second
/// differences along both directions of the grid; at its rim, those of the cell next to it. Cells
/// that are left out have none.
double variance_in_cells(std::span<const double> values, int grid,
                         std::span<const std::uint8_t> left_out) {
  const auto squared = [&](int i, int j, int step) {
    const auto at = static_cast<std::size_t>(j * grid + i);
    const auto s = static_cast<std::size_t>(step);
    const double difference = values[at - s] - 2 * values[at] + values[at + s];
    return difference * difference;
  };
  const auto inner = [&](int k) { return std::clamp(k, 1, grid - 2); };
  double sum = 0;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      if (!left_out.empty() && left_out[static_cast<std::size_t>(j * grid + i)]) continue;
      sum += squared(inner(i), j, 1) + squared(i, inner(j), grid);
    }
  }
  return sum / (12.0 * grid * grid);
}

/// The variance of the values as they are.
double variance(std::span<const double> values) {
  if (values.size() < 2) return values.empty() ? 0 : values[0] * values[0];
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return squares / (n - 1);
}

/// The variance of the mean over a grid.
double variance_of_mean(std::span<const double> values, int grid,
                        std::span<const std::uint8_t> left_out) {
  return (grid < 3 ? variance(values) : variance_in_cells(values, grid, left_out)) /
         static_cast<double>(values.size());
}

}  // namespace

double variance_of_mean(int grid, std::span<const DividedCell> divided,
                        std::span<const double> values) {
  const auto cells = static_cast<std::size_t>(grid) * static_cast<std::size_t>(grid);
  thread_local std::vector<std::uint8_t> left_out;
  left_out.assign(cells, 0);
  double within = 0;
  std::size_t first = cells;
  for (const DividedCell& cell : divided) {
    left_out[cell.cell] = 1;
    within += variance_of_mean(values.subspan(first, cell.count()), cell.parts, {});
    first += cell.count();
  }
  return variance_of_mean(values.first(cells), grid, left_out) +
         within / (static_cast<double>(cells) * static_cast<double>(cells));
}

}  // namespace isolux
