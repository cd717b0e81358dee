// The constructors of the primitives: what they refuse, and that they say so in one line.
#include <gtest/gtest.h>

#include <functional>

#include "isolux/core/error.h"
#include "isolux/geometry/blob.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/torus.h"

namespace isolux {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
const Vec3 kO{0, 0, 0}, kX{1, 0, 0}, kZ{0, 0, 1}, kBad{0, kNan, 0};

TEST(ValidationTest, OneLineThatNamesTheNumber) {
  const std::vector<std::pair<std::string, std::function<void()>>> cases = {
      {"radius", [] { Sphere(kO, 0); }},
      {"radius", [] { Sphere(kO, -1); }},
      {"radius", [] { Sphere(kO, kNan); }},
      {"radius", [] { Sphere(kO, kInf); }},
      {"radius", [] { Sphere(kO, 1e-300); }},
      {"center", [] { Sphere(kBad, 1); }},
      {"center",
       [] {
         Sphere({1e300, 0, 0}, 1);
       }},
      {"threshold", [] { Blob(0.5, {}); }},
      {"threshold",
       [] {
         Blob(0, {{kO, 1, 1}});
       }},
      {"threshold",
       [] {
         Blob(1, {{kO, 1, 1}});
       }},
      {"threshold",
       [] {
         Blob(0.5, {{kO, 1, -1}});
       }},
      {"threshold",
       [] {
         Blob(kNan, {{kO, 1, 1}});
       }},
      {"center",
       [] {
         Blob(0.5, {{kBad, 1, 1}});
       }},
      {"radius",
       [] {
         Blob(0.5, {{kO, 0, 1}});
       }},
      {"strength",
       [] {
         Blob(0.5, {{kO, 1, 1}, {kX, 1, 0}});
       }},
      {"strength",
       [] {
         Blob(0.5, {{kO, 1, kInf}});
       }},
      {"lower", [] { Box(kBad, kX); }},
      {"upper",
       [] {
         Box(kO, {1, 1, kInf});
       }},
      {"upper",
       [] {
         Box(kO, {1, 1, 0});
       }},
      {"upper",
       [] {
         Box(kO, {1, -1, 1});
       }},
      {"start", [] { Cylinder(kBad, kZ, 1, true); }},
      {"start and end", [] { Cylinder(kO, kO, 1, true); }},
      {"radius", [] { Cylinder(kO, kZ, 0, true); }},
      {"radius", [] { Cylinder(kO, kZ, kNan, false); }},
      {"start_radius", [] { Frustum(kO, kZ, -1, 1, true); }},
      {"end_radius", [] { Frustum(kO, kZ, 1, kNan, true); }},
      {"start_radius and end_radius", [] { Frustum(kO, kZ, 0, 0, true); }},
      {"center", [] { Disk(kBad, kZ, 1); }},
      {"normal", [] { Disk(kO, kO, 1); }},
      {"radius", [] { Disk(kO, kZ, 0); }},
      {"inner_radius", [] { Disk(kO, kZ, 1, 1); }},
      {"inner_radius", [] { Disk(kO, kZ, 1, -0.5); }},
      {"inner_radius", [] { Disk(kO, kZ, 1, kNan); }},
      {"axis", [] { Torus(kO, kO, 1, 0.5); }},
      {"major_radius", [] { Torus(kO, kZ, kInf, 0.5); }},
      {"minor_radius", [] { Torus(kO, kZ, 1, 1); }},
      {"minor_radius", [] { Torus(kO, kZ, 1, 0); }},
      {"corner", [] { Parallelogram(kBad, kX, kZ); }},
      {"u", [] { Parallelogram(kO, kO, kZ); }},
      {"v", [] { Parallelogram(kO, kX, kBad); }},
      {"u and v", [] { Parallelogram(kO, kX, kX * 2); }},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& [name, build] = cases[i];
    try {
      build();
      ADD_FAILURE() << "case " << i << " was taken: " << name;
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind(name + ":", 0), 0u) << i << ": " << message;
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace isolux
