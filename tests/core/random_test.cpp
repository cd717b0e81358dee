#include "isolux/core/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace isolux {
namespace {

TEST(Random, IsAFunctionOfSeedAndStream) {
  Random a(5, 9), b(5, 9);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next(), b.next());
}

TEST(Random, StreamsAndSeedsDiffer) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (std::uint64_t stream = 0; stream < 100; ++stream) {
      first.insert(Random(seed, stream).next());
    }
  }
  EXPECT_EQ(first.size(), 10000u);
}

// χ² over 64 cells has mean 63 and standard deviation √126; 4 of them for each of the properties.
double chi_squared(const std::array<int, 64>& count, int n) {
  double sum = 0;
  for (const int c : count) sum += std::pow(c - n / 64.0, 2) / (n / 64.0);
  return sum;
}
constexpr double kLimit = 63 + 4 * 11.3;

TEST(Random, IsUniform) {
  constexpr int n = 100000;
  std::array<int, 64> along{}, pairs{}, across{}, below{};
  Random random(7);
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform(), v = random.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    ++along[static_cast<std::size_t>(u * 64)];
    ++pairs[static_cast<std::size_t>(u * 8) * 8 + static_cast<std::size_t>(v * 8)];
    ++across[static_cast<std::size_t>(Random(7, static_cast<std::uint64_t>(i)).uniform() * 64)];
    ++below[random.below(64)];
  }
  EXPECT_LT(chi_squared(along, n), kLimit);
  EXPECT_LT(chi_squared(pairs, n), kLimit);
  EXPECT_LT(chi_squared(across, n), kLimit) << "the first draws of neighbouring streams";
  EXPECT_LT(chi_squared(below, n), kLimit);
}

TEST(Random, BelowOneIsZero) {
  Random random(1);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(random.below(1), 0u);
}

}  // namespace
}  // namespace isolux
