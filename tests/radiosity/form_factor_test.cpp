#include "isolux/radiosity/form_factor.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "isolux/core/random.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/sphere.h"
#include "support/scenes.h"

namespace isolux {
namespace {

constexpr double kPi = std::numbers::pi;

/// Sum over the triangles that face the point: a convex solid or a flat shape, seen whole.
double form_factor_of_soup(const Vec3& point, const Vec3& normal, const TriangleSoup& soup) {
  double sum = 0;
  for (const auto& [a, b, c] : soup.triangles) {
    const std::array<Vec3, 3> corners{soup.points[a], soup.points[b], soup.points[c]};
    const Vec3 facing = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (dot(point - corners[0], facing) > 0) sum += form_factor(point, normal, corners);
  }
  return sum;
}

TEST(FormFactor, OfASquareOverheadIsTheClosedForm) {
  // Unit square at distance 1, normal through a corner (Howell, B-3).
  const std::array<Vec3, 4> square{{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}};
  EXPECT_NEAR(form_factor({0, 0, 0}, {0, 0, 1}, square), 0.13853160599489298, 1e-15);
}

TEST(FormFactor, OfAnEnclosureIsOne) {
  // The five walls that a point of the floor sees; those at the sides are cut by its horizon.
  const Vec3 point{0.3, 0.6, 0}, up{0, 0, 1};
  const double h = 0.7;
  double sum =
      form_factor(point, up, std::array<Vec3, 4>{{{0, 0, h}, {1, 0, h}, {1, 1, h}, {0, 1, h}}});
  const std::array<Vec3, 4> rim{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  for (int i = 0; i < 4; ++i) {
    const Vec3 a = rim[i], b = rim[(i + 1) % 4], down{0, 0, -5}, top{0, 0, h};
    sum += form_factor(point, up, std::array<Vec3, 4>{{a + down, b + down, b + top, a + top}});
  }
  EXPECT_NEAR(sum, 1, 1e-14);
}

TEST(FormFactor, IsZeroBelowTheHorizonAndAdditive) {
  const Vec3 up{0, 0, 1};
  const std::array<Vec3, 3> below{{{0, 0, -1}, {1, 0, -1}, {0, 1, -0.1}}};
  EXPECT_EQ(form_factor({0, 0, 0}, up, below), 0);
  const Vec3 a{1, 0, -1}, b{0, 2, 1}, c{-1, 0, 2}, mid = (a + b) / 2;
  const double whole = form_factor({0, 0, 0}, up, std::array{a, b, c});
  const double parts = form_factor({0, 0, 0}, up, std::array{a, mid, c}) +
                       form_factor({0, 0, 0}, up, std::array{mid, b, c});
  EXPECT_NEAR(whole, parts, 1e-14);
}

TEST(FormFactor, TinyAndHugeSolidAnglesAreExact) {
  // Against A cos cos / (π d²), far away; against 1, close by.
  const double s = 1e-4;
  const std::array<Vec3, 3> tiny{{{0, 0, 1}, {s, 0, 1}, {0, s, 1}}};
  EXPECT_NEAR(form_factor({0, 0, 0}, {0, 0, 1}, tiny) / (s * s / 2 / kPi), 1, 1e-7);
  const std::array<Vec3, 4> huge{{{-1, -1, 1e-6}, {1, -1, 1e-6}, {1, 1, 1e-6}, {-1, 1, 1e-6}}};
  EXPECT_NEAR(form_factor({0, 0, 0}, {0, 0, 1}, huge), 1, 1e-11);
}

TEST(FormFactor, OfASphereIsThatOfManyTriangles) {
  const Vec3 center{0.2, -0.1, 0.4};
  const double radius = 0.3;
  const TriangleSoup soup = *Sphere(center, radius).triangulate(0.006);
  Random random(8);
  std::array<int, 3> count{};
  for (int i = 0; i < 100; ++i) {
    const Vec3 way = normalized(Vec3{random.uniform(), random.uniform(), random.uniform()} -
                                Vec3{0.5, 0.5, 0.5});
    const Vec3 point = center - way * (radius * (1.05 + 4 * std::pow(random.uniform(), 3)));
    const double sine = radius / distance(center, point);
    // The angle between normal and centre, from well above to below the horizon.
    const double angle =
        kPi / 2 + (i % 3 == 0 ? 3 : 1) * (2 * random.uniform() - 1) * std::asin(sine);
    const Frame frame(way);
    const Vec3 normal = frame.to_world({std::sin(angle), 0, std::cos(angle)});
    const double expected = form_factor_of_soup(point, normal, soup);
    const double found = sphere_form_factor(point, normal, center, radius);
    EXPECT_NEAR(found, expected, 3e-4 * sine * sine) << i;
    ++count[found == 0 ? 0 : angle < kPi / 2 ? 1 : 2];
  }
  for (const int some : count) EXPECT_GT(some, 3);
}

TEST(FormFactor, OfASphereIsExactAtItsLimits) {
  const Vec3 up{0, 0, 1}, center{0, 0, 2};
  EXPECT_NEAR(sphere_form_factor({0, 0, 0}, up, center, 0.5), 1. / 16, 1e-15);
  EXPECT_NEAR(sphere_form_factor({0, 0, 0}, up, center, 2 - 1e-9), 1, 2e-9);
  EXPECT_EQ(sphere_form_factor({0, 0, 0}, up, center, 2.1), 0) << "inside";
  EXPECT_EQ(sphere_form_factor({0, 0, 0}, {0, 0, -1}, center, 1.9), 0) << "turned away";
  // On the horizon half a hemisphere's view from close by; elsewhere continuous.
  EXPECT_NEAR(sphere_form_factor({0, 0, 0}, {1, 0, 0}, center, 2 - 1e-9), 0.5, 1e-4);
  const double sine = 0.25, grazing = kPi / 2 - std::asin(sine), step = 1e-6;
  for (const double angle : {grazing, kPi - grazing}) {
    const auto at = [&](double a) {
      return sphere_form_factor({0, 0, 0}, {std::sin(a), 0, std::cos(a)}, center, 2 * sine);
    };
    EXPECT_NEAR(at(angle - step), at(angle + step), 1e-6);
  }
  // A speck on the horizon: the mean cosine of a half disk is 4 / 3π of its radius.
  const double radius = 2e-4;
  EXPECT_NEAR(sphere_form_factor({0, 0, 0}, {1, 0, 0}, center, radius) /
                  (2. / 3 / kPi * std::pow(radius / 2, 3)),
              1, 1e-6);
}

/// One entry of the list of closed forms; what comes out of the method, and how near it must be.
struct Computed {
  double value, tolerance;
};

std::optional<Computed> compute(const std::string& formula, const nlohmann::json& p) {
  const auto number = [&](const char* key) { return p.at(key).get<double>(); };
  const Vec3 up{0, 0, 1}, origin{0, 0, 0};
  const auto polygon = [&](std::array<Vec3, 4> corners) {
    return Computed{form_factor(origin, up, corners), 1e-6};
  };
  const double kCurved = 2e-4;  // as polygons
  if (formula == "B_par_corner") {
    const double a = number("a"), b = number("b"), c = number("c");
    return polygon({{{0, 0, c}, {a, 0, c}, {a, b, c}, {0, b, c}}});
  }
  if (formula == "B_perp_corner") {
    // The rectangle stands on the receiver's level at distance c: a wide, b high.
    const double a = number("a"), b = number("b"), c = number("c");
    return polygon({{{c, 0, 0}, {c, a, 0}, {c, a, b}, {c, 0, b}}});
  }
  if (formula == "B_disc_par") {
    const Disk disk({number("a"), 0, number("h")}, {0, 0, -1}, number("r"));
    return Computed{form_factor_of_soup(origin, up, *disk.triangulate(0.02)), kCurved};
  }
  if (formula == "B_disc_perp") {
    const Disk disk({number("l"), 0, number("h")}, {0, 0, -1}, number("r"));
    return Computed{form_factor_of_soup(origin, {1, 0, 0}, *disk.triangulate(0.02)), kCurved};
  }
  if (formula == "B_sphere") {
    const double t = number("theta");
    const Sphere sphere({number("d") * std::sin(t), 0, number("d") * std::cos(t)}, number("r"));
    return Computed{form_factor_of_soup(origin, up, *sphere.triangulate(0.05)), 1e-3};
  }
  if (formula == "B_cyl") {
    const double s = number("s");
    const Cylinder cylinder({0, 0, s}, {0, number("h"), s}, number("r"), false);
    return Computed{form_factor_of_soup(origin, up, *cylinder.triangulate(0.05)), 1e-3};
  }
  return std::nullopt;  // between finite areas: not what the kernel computes
}

TEST(FormFactor, AgreesWithThePublishedClosedForms) {
  ISOLUX_NEED_SHARED();
  std::ifstream in(shared_dir() / "validation/cases/form_factors_closed.json");
  const auto list = nlohmann::json::parse(in).at("values");
  int compared = 0;
  for (const auto& entry : list) {
    const auto computed = compute(entry.at("formula"), entry.at("params"));
    if (!computed) continue;
    const double expected = entry.at("F");
    EXPECT_NEAR(computed->value / expected, 1, computed->tolerance) << entry.dump();
    ++compared;
  }
  EXPECT_GE(compared, 18);
}

TEST(FormFactor, OfManyReceiversIsThatOfEach) {
  Random random(4);
  const auto point = [&] { return Vec3{random.uniform(), random.uniform(), random.uniform()}; };
  std::size_t whole = 0;
  for (int i = 0; i < 300; ++i) {
    // From tiny and far away to large and cut by the horizon; a corner itself once.
    const double size = std::pow(10, -3 * random.uniform());
    const Vec3 p = point();
    const std::array<Vec3, 3> triangle{p, p + point() * size, p - point() * size};
    std::vector<Receiver> receivers{{p, {0, 0, 1}}};
    std::vector<std::uint32_t> indices;
    for (std::uint32_t k = 0; k < 37; ++k) {
      receivers.push_back({point(), normalized(point() - Vec3{0.5, 0.5, 0.5})});
      if (k % 3 != 1) indices.push_back(k);
    }
    std::vector<double> factors(receivers.size(), -1);
    form_factors(receivers, indices, triangle, factors);
    for (std::uint32_t k = 0; k < receivers.size(); ++k) {
      const bool asked = std::find(indices.begin(), indices.end(), k) != indices.end();
      const double alone = form_factor(receivers[k].point, receivers[k].normal, triangle);
      EXPECT_EQ(factors[k], asked ? alone : -1) << "triangle " << i << ", receiver " << k;
      whole += asked && alone > 0;
    }
  }
  EXPECT_GT(whole, 1000u);
}

}  // namespace
}  // namespace isolux
