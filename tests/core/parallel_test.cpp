#include "isolux/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace isolux {
namespace {

using Ranges = std::set<std::pair<std::size_t, std::size_t>>;

Ranges ranges_of(std::size_t n, std::size_t grain, int threads) {
  const ThreadLimit limit(threads);
  Ranges ranges;
  std::mutex mutex;
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    const std::scoped_lock lock(mutex);
    ranges.emplace(begin, end);
  });
  return ranges;
}

TEST(ParallelFor, CoversEveryIndexOnce) {
  for (const std::size_t n : {0u, 1u, 7u, 64u, 1000u}) {
    for (const std::size_t grain : {0u, 1u, 7u, 64u, 5000u}) {
      std::vector<std::atomic<int>> visits(n);
      parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& count : visits) EXPECT_EQ(count, 1);
    }
  }
}

TEST(ParallelFor, RangesDoNotDependOnTheThreads) {
  for (const std::size_t n : {1u, 99u, 100u, 101u, 1234u}) {
    const Ranges one = ranges_of(n, 10, 1);
    EXPECT_EQ(one.size(), (n + 9) / 10);
    for (const int threads : {0, 2, 4}) EXPECT_EQ(ranges_of(n, 10, threads), one);
  }
}

TEST(ParallelFor, SumsPerRangeAreTheSameBitsForAnyThreads) {
  const auto sum = [](int threads) {
    const ThreadLimit limit(threads);
    constexpr std::size_t n = 10007, grain = 64;
    std::vector<double> partial((n + grain - 1) / grain);
    parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        partial[begin / grain] += std::sin(static_cast<double>(i));
      }
    });
    double total = 0;
    for (const double p : partial) total += p;
    return total;
  };
  EXPECT_EQ(sum(1), sum(2));
  EXPECT_EQ(sum(1), sum(4));
}

TEST(ParallelFor, RethrowsAndStaysUsable) {
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    EXPECT_THROW(parallel_for(1000, 1,
                              [](std::size_t begin, std::size_t) {
                                if (begin == 500) throw std::runtime_error("here");
                              }),
                 std::runtime_error);
    std::atomic<std::size_t> count = 0;
    parallel_for(1000, 1, [&](std::size_t begin, std::size_t end) { count += end - begin; });
    EXPECT_EQ(count, 1000u);
  }
}

TEST(ParallelFor, MayBeNested) {
  std::atomic<std::size_t> count = 0;
  parallel_for(20, 1, [&](std::size_t, std::size_t) {
    parallel_for(50, 10, [&](std::size_t begin, std::size_t end) { count += end - begin; });
  });
  EXPECT_EQ(count, 1000u);
}

#ifdef __SANITIZE_THREAD__
// What the thread sanitizer is told of a loop's order, and not to look at, must not hide a race.
TEST(ParallelForDeathTest, TheThreadSanitizerFindsARaceBetweenRanges) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "needs two processors";
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto race = [] {
    std::size_t count = 0;
    parallel_for(200, 1, [&](std::size_t begin, std::size_t end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      count += end - begin;
    });
    std::exit(0);
  };
  EXPECT_EXIT(race(), testing::ExitedWithCode(66), "data race");
}
#endif

}  // namespace
}  // namespace isolux
