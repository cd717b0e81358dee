#pragma once

#include <chrono>
#include <ctime>

namespace isolux {

/// Counts from its making on.
class Stopwatch {
 public:
  /// s
  double wall() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// s, of all threads together
  double cpu() const { return double(std::clock() - cpu_start_) / CLOCKS_PER_SEC; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::clock_t cpu_start_ = std::clock();
};

}  // namespace isolux
