#include <gtest/gtest.h>

#include <numbers>

#include "isolux/core/random.h"
#include "isolux/radiosity/ball_view.h"
#include "isolux/radiosity/direct_light.h"
#include "support/penumbrae.h"

namespace isolux {
namespace {

/// What the receiver gets from the scene's first object, a ball of exitance 1, by rays spread over
/// all ways that meet the ball.
double by_brute_force(const RayCaster& rays, const Receiver& receiver, const Vec3& center,
                      double radius) {
  constexpr int kSide = 160;
  const Vec3 way = center - receiver.point;
  const double d = length(way);
  const Frame frame(way / d);
  const double cosine = std::sqrt(1 - radius * radius / (d * d));
  Random random(3);
  double sum = 0;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const double u = (i + random.uniform()) / kSide;
      const double angle = 2 * std::numbers::pi * (j + random.uniform()) / kSide;
      const double z = 1 - u * (1 - cosine), r = std::sqrt(1 - z * z);
      const Vec3 direction = frame.to_world({r * std::cos(angle), r * std::sin(angle), z});
      const double above = dot(direction, receiver.normal);
      if (above <= 0) continue;
      const auto hit = rays.nearest({receiver.point + receiver.normal * rays.epsilon(), direction});
      if (hit && hit->surface.object == 0) sum += above;
    }
  }
  return 2 * (1 - cosine) * sum / (kSide * kSide);
}

struct Counts {
  int lit = 0, partly = 0, dark = 0;
};

/// Holds the light that the receivers get from the first object, a ball, in a group and each by
/// itself, against brute force.
Counts expect_brute_force(const std::string& objects, const Vec3& center, double radius,
                          const std::vector<Receiver>& receivers) {
  const Scene scene = scene_of(kMaterials + objects);
  const RayCaster rays(scene);
  const DirectLight light(rays);
  Counts counts;
  for (const double tolerance : {0.0, 0.08}) {
    std::vector<Rgb> irradiance(receivers.size());
    std::vector<double> error(receivers.size());
    light.irradiance(receivers, irradiance, error, tolerance);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const Receiver& r = receivers[i];
      // Where the horizon leaves a sliver of the ball, a fifth of what it is upright.
      const double sine = radius / distance(r.point, center);
      const double open = sphere_form_factor(r.point, r.normal, center, radius);
      const double whole = std::max(open, 0.2 * sine * sine);
      const double expected = by_brute_force(rays, r, center, radius);
      Rgb alone;
      double error_alone = 0;
      light.irradiance({&r, 1}, {&alone, 1}, {&error_alone, 1}, tolerance);
      // The reference itself is off by some 1e-3 of the whole, where an edge runs through.
      for (const auto& [e, sigma] : {std::pair{luminance(irradiance[i]), error[i]},
                                     std::pair{luminance(alone), error_alone}}) {
        EXPECT_NEAR(e, expected, (0.005 + tolerance / 2) * whole) << i << ", " << tolerance;
        EXPECT_NEAR(e, expected, 4 * sigma + 2e-3 * whole) << i << ", " << tolerance;
      }
      ++(expected < 0.01 * open   ? counts.dark
         : expected < 0.97 * open ? counts.partly
                                  : counts.lit);
    }
  }
  return counts;
}

std::string ball(const Vec3& center, double radius) {
  return "  - {shape: {sphere: {center: [" + std::to_string(center.x) + ", " +
         std::to_string(center.y) + ", " + std::to_string(center.z) +
         "], radius: " + std::to_string(radius) + "}}, material: black, emission: {exitance: 1}}\n";
}

const std::string kFar =
    "  - {shape: {sphere: {center: [9, 9, 9], radius: 0.1}}, material: black}\n";

TEST(BallLight, PartlyHiddenIsSeenAsByManyRays) {
  const Vec3 center{0, 0, 2};
  const std::string things =
      "  - {shape: {box: {lower: [0.1, -0.3, 1], upper: [1, 0.5, 1.1]}}, material: black}\n"
      "  - {shape: {cylinder: {from: [-0.6, -1, 0.8], to: [-0.4, 1, 1], radius: 0.05}}, material: "
      "black}\n"
      "  - {shape: {sphere: {center: [0, -0.9, 0.6], radius: 0.2}}, material: black}\n";
  std::vector<Receiver> receivers;
  Random random(2);
  for (int i = 0; i < 60; ++i) {
    receivers.push_back({{3 * random.uniform() - 1.5, 3 * random.uniform() - 1.5, 0}, {0, 0, 1}});
  }
  const Counts counts = expect_brute_force(ball(center, 0.4) + things, center, 0.4, receivers);
  EXPECT_GT(counts.partly, 30);
}

TEST(BallLight, AHorizonThatCutsItIsNoShadow) {
  // The receivers are on a ball whose own surface is their horizon, beside a screen.
  const Vec3 center{0, 0, 1};
  const std::string things =
      "  - {shape: {sphere: {center: [0, 0, -0.5], radius: 0.5}}, material: black}\n";
  const std::string screen =
      "  - {shape: {parallelogram: {corner: [0.1, -1, 0.3], u: [0.6, 0, 0.1], v: [0, 2, 0]}}, "
      "material: black}\n";
  std::vector<Receiver> receivers;
  Random random(4);
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * std::numbers::pi * random.uniform(), z = 0.8 * random.uniform();
    const double r = std::sqrt(1 - z * z);
    const Vec3 normal{r * std::cos(angle), r * std::sin(angle), z};
    receivers.push_back({Vec3{0, 0, -0.5} + normal * 0.5, normal});
  }
  const Counts open = expect_brute_force(ball(center, 0.4) + things, center, 0.4, receivers);
  EXPECT_LT(open.partly, 4) << "but for noise, where hardly anything is above the horizon";
  const Counts counts =
      expect_brute_force(ball(center, 0.4) + things + screen, center, 0.4, receivers);
  EXPECT_GT(counts.partly, 10);
}

TEST(BallLight, HalfSunkInACeiling) {
  const Vec3 center{0, 0, 2};
  const std::string ceiling =
      "  - {shape: {box: {lower: [-3, -3, 2], upper: [3, 3, 2.5]}}, material: black}\n";
  std::vector<Receiver> receivers;
  for (int i = 0; i < 12; ++i) {
    receivers.push_back({{0.25 * i, 0.1, 0}, {0, 0, 1}});
    receivers.push_back({{0.41 + 0.04 * i * i / 2, 0.1, 2}, {0, 0, -1}});  // beside the ball
    receivers.push_back({{2, 0, 0.17 * i}, {-1, 0, 0}});
    receivers.push_back({{0.1, 0.03 * i, 2}, {0, 0, -1}});  // most are inside the ball
  }
  std::vector<Receiver> outside;
  for (const Receiver& r : receivers) {
    if (distance(r.point, center) > 0.4) outside.push_back(r);
  }
  const Counts counts = expect_brute_force(ball(center, 0.4) + ceiling, center, 0.4, outside);
  EXPECT_GT(counts.partly, 20);
  EXPECT_GT(counts.lit, 2);
  // What is inside the ball gets nothing.
  const Scene scene = scene_of(kMaterials + ball(center, 0.4) + ceiling);
  const RayCaster rays(scene);
  Rgb e;
  double error = 0;
  const Receiver inside{{0.1, 0.03, 2}, {0, 0, -1}};
  DirectLight(rays).irradiance({&inside, 1}, {&e, 1}, {&error, 1});
  EXPECT_EQ(luminance(e), 0);
}

TEST(BallLight, WithASupportAndOnTheFloor) {
  // The ball lies on the floor, and a rod runs from its top; receivers on floor and rod, down to
  // where they touch it.
  const Vec3 center{0, 0, 0.4};
  const std::string things =
      "  - {shape: {disk: {center: [0, 0, 0], normal: z, radius: 4}}, material: black}\n"
      "  - {shape: {cylinder: {from: [0, 0, 0.78], to: [0, 0, 1.5], radius: 0.1}}, "
      "material: black}\n";
  std::vector<Receiver> receivers;
  for (int i = 0; i < 20; ++i) {
    const double x = 1e-3 * std::pow(1.5, i);
    receivers.push_back({{x, 0.2 * x, 0}, {0, 0, 1}});
    if (x < 0.7) receivers.push_back({{0.1, 0, 0.788 + x}, {1, 0, 0}});
    receivers.push_back({{x, 0, 2}, {0, 0, -1}});  // above the rod
  }
  const Counts counts = expect_brute_force(ball(center, 0.4) + things, center, 0.4, receivers);
  EXPECT_GT(counts.lit, 30);
  EXPECT_GT(counts.partly, 5);
}

TEST(BallLight, DoesNotLightItselfAndNeedsNoShapeOfItsOwn) {
  const Vec3 center{1, 2, 3};
  const Scene scene = scene_of(kMaterials + ball(center, 0.4) + kFar);
  const Scene moved =
      scene_of(kMaterials +
               "  - {shape: {sphere: {center: [0, 0, 0], radius: 0.2}}, transform: [{scale: 2}, "
               "{translate: [1, 2, 3]}], material: black, emission: {exitance: 1}}\n" +
               kFar);
  const RayCaster rays(scene), moved_rays(moved);
  Random random(6);
  for (int i = 0; i < 20; ++i) {
    const Vec3 way = normalized(Vec3{random.uniform(), random.uniform(), random.uniform()} -
                                Vec3{0.5, 0.5, 0.5});
    const Receiver own{center + way * 0.4, way}, other{center + way, -way};
    for (const RayCaster* caster : {&rays, &moved_rays}) {
      Rgb e;
      double error = 0;
      DirectLight(*caster).irradiance({&own, 1}, {&e, 1}, {&error, 1});
      EXPECT_EQ(luminance(e), 0);
      DirectLight(*caster).irradiance({&other, 1}, {&e, 1}, {&error, 1});
      EXPECT_NEAR(luminance(e), 0.16, 1e-12);
    }
  }
}

TEST(BallView, ItsPointsAreTheFirstOfTheBall) {
  const Ball ball{{0.3, 0.2, 0.1}, 0.5, 1e-7};
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    const Vec3 way = normalized(Vec3{random.uniform(), random.uniform(), random.uniform()} -
                                Vec3{0.5, 0.5, 0.5});
    const Receiver receiver{ball.center + way * (0.5 + std::pow(10, -4 * random.uniform())), way};
    const BallView view(receiver, ball);
    const double angle = 2 * std::numbers::pi * random.uniform();
    const double r = i % 4 == 0 ? 1 : std::sqrt(random.uniform());
    const Vec3 point = view.point({r * std::cos(angle), r * std::sin(angle), 0});
    EXPECT_NEAR(distance(point, ball.center), ball.radius + ball.lift, 1e-14);
    // The surface there faces the receiver, on the rim edge-on.
    const double facing = dot(point - ball.center, receiver.point - point);
    EXPECT_GE(facing, -1e-6);
    EXPECT_LE(facing, r == 1 ? 1e-6 : 2);
    const Bounds box = view.bounds();
    const Vec3 hair = Vec3{1, 1, 1} * 1e-8;
    EXPECT_TRUE((Bounds{box.lower - hair, box.upper + hair}).encloses({point, point}));
    EXPECT_LE(box.diagonal(), std::sqrt(12.) * (ball.radius + ball.lift) + 1e-12);
  }
}

}  // namespace
}  // namespace isolux
