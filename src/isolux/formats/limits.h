#pragma once

#include <cstddef>

namespace isolux {

// What readers of scenes make at most, so that a small file can't ask for more than there is.

inline constexpr std::size_t kLargestMainFile = std::size_t{64} << 20;  ///< of a main file
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION  // sanitizers take thirty times as long
inline constexpr std::size_t kMostObjects = 10'000;
#else
inline constexpr std::size_t kMostObjects = 250'000;
#endif
inline constexpr double kFarthest = 1e9;  ///< m, of points of meshes along each axis
inline constexpr std::size_t kMostMaps = 4 * kMostObjects;  ///< of all transforms together
inline constexpr double kMostCornerPairs = 1e8;    ///< of all faces: the effort to make them
inline constexpr double kMostReflectance = 0.999;  ///< larger ones are reduced to it
inline constexpr double kMostExitance = 1e12;      ///< lm/m²

}  // namespace isolux
