// A light above a plate, solved through the installed library.
#include <isolux/core/version.h>
#include <isolux/radiosity/solve.h>
#include <isolux/scene/reader.h>

#include <cstdio>

constexpr const char* kScene = R"(isolux: 1
materials: {white: {reflectance: 0.5}}
objects:
  - {shape: {parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0]}}, material: white}
  - shape: {parallelogram: {corner: [0, 0, 1], u: [0, 1, 0], v: [1, 0, 0]}}
    material: white
    emission: {exitance: 100}
cameras: {front: {eye: [0.5, -2, 0.5], look_at: [0.5, 0.5, 0.5]}}
)";

int main() {
  isolux::Options options;
  options.tolerance = 0.1;
  const isolux::Solved solved = isolux::solve(isolux::read_scene(kScene, "scene"), options);
  std::printf("isolux %s: %zu triangles\n", isolux::kVersion, solved.mesh.triangle_count());
  return solved.mesh.triangle_count() > 0 ? 0 : 1;
}
