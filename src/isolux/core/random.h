#pragma once

#include <algorithm>
#include <cstdint>

namespace isolux {

/// A counter-based generator: every draw is a pure function of seed, stream and counter, so the
/// numbers that a piece of work sees do not depend on which thread does it or in what order.
class Random {
 public:
  /// Stream `stream` of seed `seed`; different pairs give independent sequences.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : key_(mix(mix(seed) ^ (stream * 0xd1342543de82ef95u + 0x632be59bd9b4e019u))) {}

  /// The next number, uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  /// The next number, uniform in 0 … n − 1 (n > 0).
  std::uint64_t below(std::uint64_t n) {
    return std::min(static_cast<std::uint64_t>(uniform() * static_cast<double>(n)), n - 1);
  }

  std::uint64_t next() { return mix(key_ + 0x9e3779b97f4a7c15u * ++counter_); }

 private:
  /// The finalizer of SplitMix64 (Steele, Lea, Flood 2014, variant 13).
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace isolux
