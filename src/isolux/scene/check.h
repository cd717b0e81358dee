#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "isolux/scene/scene.h"

namespace isolux {

/// What was understood of an object.
struct ObjectReport {
  std::string name;
  std::string material;
  std::optional<double> area;  ///< m²; nothing where it has no formula (CSG)
  double flux = 0;             ///< emitted, lm
  Bounds bounds;               ///< m
};

/// What was understood of a sky.
struct SkyReport {
  double illuminance = 0;  ///< of an open horizontal surface by the sky alone, lx
  double ground = 0;       ///< luminance below the horizon, cd/m²
};
SkyReport report_sky(const Sky& sky);

/// What was understood of a scene, and what looks doubtful in it.
struct SceneReport {
  std::string name;
  std::string unit;  ///< of plain numbers in the file
  std::size_t object_count = 0;
  std::vector<ObjectReport> objects;              ///< the first ones
  std::map<std::string, std::size_t> primitives;  ///< how many of each kind; of CSG, its operands'
  std::size_t materials = 0;
  std::size_t cameras = 0;
  std::size_t lights = 0;  ///< objects, sources and the sky
  double flux = 0;         ///< of all lights whose flux is known, lm
  std::optional<SkyReport> sky;
  Bounds bounds;                      ///< m
  std::vector<std::string> warnings;  ///< each one line
};

/// Adds the first three of `alike`, warnings of one kind, and how many more there are.
void add_some(std::vector<std::string>& warnings, const std::vector<std::string>& alike);

/// Sums up the scene and looks for what is allowed but probably not meant. Casts no rays. Says more
/// of the first `listed` objects.
SceneReport check_scene(const Scene& scene, std::size_t listed = 100);

}  // namespace isolux
