#include "isolux/geometry/polygon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "geometry/zoo.h"
#include "isolux/core/affine.h"
#include "isolux/core/error.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {
namespace {

using Outline = std::vector<Vec3>;

/// Concave outlines in the plane z = 0, counter-clockwise.
std::vector<Outline> outlines() {
  Outline star, comb, spiral, beaded;
  for (int i = 0; i < 30; ++i) {
    const double r = i % 2 ? 0.35 : 1, a = i * std::numbers::pi / 15;
    star.push_back({r * std::cos(a), r * std::sin(a), 0});
  }
  for (int i = 20; i-- > 0;) {
    comb.push_back({0.1 * i + 0.05, 1, 0});
    comb.push_back({0.1 * i, 0.02, 0});
  }
  comb.push_back({0, 0, 0});
  comb.push_back({2, 0, 0});
  Outline back;
  for (int i = 0; i <= 60; ++i) {
    const double a = 0.2 * i, r = 0.3 + 0.06 * a;
    spiral.push_back({(r + 0.1) * std::cos(a), (r + 0.1) * std::sin(a), 0});
    back.push_back({r * std::cos(a), r * std::sin(a), 0});
  }
  spiral.insert(spiral.end(), back.rbegin(), back.rend());
  for (int i = 0; i < 10; ++i) beaded.push_back({0.1 * i, 0, 0});  // corners along straight sides
  for (int i = 0; i < 10; ++i) beaded.push_back({1, 0.1 * i, 0});
  for (int i = 0; i < 10; ++i) beaded.push_back({1 - 0.1 * i, 1 - 0.1 * i, 0});
  return {star,
          comb,
          spiral,
          beaded,
          {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}};
}

double shoelace(const Outline& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += 0.5 * cross(p[i], p[(i + 1) % p.size()]).z;
  return sum;
}

/// By the sum of the angles under which the sides are seen.
bool winds_around(const Outline& p, const Vec3& q) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 a = p[i] - q, b = p[(i + 1) % p.size()] - q;
    sum += std::atan2(cross(a, b).z, dot(a, b));
  }
  return sum > std::numbers::pi;
}

TEST(PolygonTest, AreaIsTheShoelaceAreaInAnyPose) {
  const Affine pose = Affine::translate({5, -3, 2}) * Affine::rotate({1, 2, 3}, 1);
  for (Outline outline : outlines()) {
    const double area = shoelace(outline);
    ASSERT_GT(area, 0);
    for (const bool reversed : {false, true}) {
      Outline placed;
      for (const Vec3& p : outline) placed.push_back(pose.point(p));
      if (reversed) std::reverse(placed.begin(), placed.end());
      const Polygon polygon(placed);
      EXPECT_NEAR(*polygon.area(), area, 1e-12);
      const Vec3 normal = pose.vector({0, 0, reversed ? -1.0 : 1.0});
      const TriangleSoup soup = *polygon.triangulate(0.15);
      EXPECT_NEAR(isolux::area(soup), area, 1e-12);
      for (const auto& [a, b, c] : soup.triangles) {
        const Vec3 &p = soup.points[a], &q = soup.points[b], &r = soup.points[c];
        EXPECT_GT(dot(cross(q - p, r - p), normal), 0);
        EXPECT_LE(distance(p, q), 0.15 * (1 + 1e-6));
      }
    }
  }
}

TEST(PolygonTest, IsHitWhereTheOutlineWindsAround) {
  Random random(2);
  for (const Outline& outline : outlines()) {
    const Polygon polygon(outline);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p{4 * random.uniform() - 2, 4 * random.uniform() - 2, 0};
      const Vec3 d = random_direction(random);
      const Hits hits = hits_of(polygon, {p - d, d});
      EXPECT_EQ(!hits.empty(), winds_around(outline, p)) << p.x << ' ' << p.y;
      for (const Hit& h : hits) EXPECT_NEAR(h.t, 1, 1e-9);
    }
  }
}

TEST(PolygonTest, EdgesAndCornersAreHit) {
  for (const Outline& outline : outlines()) {
    const Polygon polygon(outline);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3 a = outline[i], b = outline[(i + 1) % outline.size()];
      for (const double w : {0.0, 0.3, 0.5}) {
        EXPECT_EQ(hits_of(polygon, {a + (b - a) * w + Vec3{0, 0, 3}, {0, 0, -1}}).size(), 1u);
      }
    }
  }
}

TEST(PolygonTest, RefusesWhatIsNoPolygon) {
  const auto message = [](const Outline& corners) -> std::string {
    try {
      Polygon polygon(corners);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  using testing::HasSubstr;
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}}), HasSubstr("3 to 1000 corners"));
  EXPECT_THAT(message(Outline(1001)), HasSubstr("3 to 1000 corners"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), HasSubstr("no area"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), HasSubstr("no area"));
  EXPECT_THAT(message({{0, 0, 0}, {3, 1, 0}, {3, 0, 0}, {0, 2, 0}}), HasSubstr("cross itself"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-3}, {0, 1, 0}}), HasSubstr("off the plane"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}), HasSubstr("same"));
  EXPECT_THAT(message({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}}), HasSubstr("turns back"));
  EXPECT_THAT(message({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}}), HasSubstr("touch"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}), HasSubstr("points[2]"));
  EXPECT_EQ(message({{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-7}, {0, 1, 0}}), "");
}

}  // namespace
}  // namespace isolux
