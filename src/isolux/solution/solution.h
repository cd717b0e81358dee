#pragma once

#include <filesystem>
#include <string>

#include "isolux/discretization/triangulation.h"
#include "isolux/radiosity/options.h"
#include "isolux/radiosity/statistics.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// The result of a solve, with all that is needed to render or measure it elsewhere.
struct Solution {
  Scene scene;
  Triangulation mesh;
  Options options;
  Statistics statistics;
  std::string version;  ///< of the isolux that solved it
};

/// Writes one self-contained GLB (docs/solution-format.md): whole or not at all. The same
/// solution gives the same bytes. Throws InputError where the file can't be written.
void save_solution(const Solution& solution, const std::filesystem::path& path);

/// Reads what save_solution wrote. Throws InputError, with the file's name, where the file is
/// truncated, not a GLB, or not a solution of isolux.
Solution load_solution(const std::filesystem::path& path);

}  // namespace isolux
