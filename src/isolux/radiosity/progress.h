#pragma once

#include <cstdint>
#include <functional>

namespace isolux {

/// How far a solve has come.
struct Progress {
  int iteration = 0;
  int iterations = 0;          ///< at most; 0: not known
  double error = 0;            ///< gathering: estimated, relative, 0 before there is one
  double unshot_fraction = 1;  ///< of the emitted flux
  std::uint64_t triangles = 0;
  double rays_per_second = 0;  ///< so far, on average
  double seconds_left = 0;     ///< estimated
};

/// Asked after every iteration; returns false to stop with what there is.
using ProgressCallback = std::function<bool(const Progress&)>;

}  // namespace isolux
