#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/scenes.h"

namespace isolux {

inline const std::string kMaterials =
    "materials: {black: {reflectance: 0}, grey: {reflectance: 0.5}}\nobjects:\n";
inline const std::string kSquare =
    "  - {shape: {parallelogram: {corner: [-0.5, -0.5, 2], u: [0, 1, 0], v: [1, 0, 0]}}, "
    "material: black, sides: front, emission: {exitance: 1}}\n";
inline const std::string kDisk =
    "  - {shape: {disk: {center: [0, 0, 2], normal: [0, 0, -1], radius: 0.5}}, material: black, "
    "sides: front, emission: {exitance: 1}}\n";
inline const std::string kFarDisk =
    "  - {shape: {disk: {center: [0, 0, 4], normal: [0, 0, -1], radius: 1}}, material: black, "
    "sides: front, emission: {exitance: 1}}\n";
inline const std::string kHalfPlane =
    "  - {shape: {parallelogram: {corner: [-20, -20, 1], u: [20, 0, 0], v: [0, 40, 0]}}, "
    "material: black}\n";
inline const std::string kBlocker =
    "  - {shape: {disk: {center: [0, 0, 2], normal: [0, 0, 1], radius: 0.3}}, material: black}\n";

/// A penumbra whose true course is known: the file of the case, the light, what hides part of it.
struct PenumbraCase {
  const char* file;
  std::string light, occluder;

  Scene open() const { return scene_of(kMaterials + light); }
  Scene shadowed() const { return scene_of(kMaterials + light + occluder); }
};
inline const PenumbraCase kSquareBehindEdge{"penumbra_square_halfplane.json", kSquare, kHalfPlane};
inline const PenumbraCase kDiskBehindEdge{"penumbra_disc_halfplane.json", kDisk, kHalfPlane};
inline const PenumbraCase kDiskBehindDisk{"annular_occluder_disc.json", kFarDisk, kBlocker};

/// The true irradiance (lx) at (x, 0, 0), facing up, for each x of the case.
inline std::vector<std::pair<double, double>> true_values(const PenumbraCase& penumbra) {
  std::ifstream in(shared_dir() / "validation/cases" / penumbra.file);
  const nlohmann::json data = nlohmann::json::parse(in);
  std::vector<std::pair<double, double>> values;
  for (const auto& [x, e] : data.at("expected").at("values").items()) {
    values.emplace_back(std::stod(x), e.get<double>());
  }
  return values;
}

}  // namespace isolux
