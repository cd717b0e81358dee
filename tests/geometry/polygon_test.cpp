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

Outline square(double x, double y, double size) {
  return {{x, y, 0}, {x + size, y, 0}, {x + size, y + size, 0}, {x, y + size, 0}};
}

TEST(PolygonTest, HolesAreLeftOut) {
  // A grid of 100 holes, every other one wound the other way.
  std::vector<Outline> holes;
  for (int i = 0; i < 100; ++i) {
    holes.push_back(square(i % 10 + 0.1 * (i % 7) + 0.1, i / 10 + 0.3, 0.25));
    if (i % 2) std::reverse(holes.back().begin(), holes.back().end());
  }
  const Polygon sieve(square(0, 0, 10), holes);
  EXPECT_NEAR(*sieve.area(), 100 - 100 * 0.25 * 0.25, 1e-12);
  EXPECT_NEAR(isolux::area(*sieve.triangulate(0.2)), *sieve.area(), 1e-9);
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p{10 * random.uniform(), 10 * random.uniform(), 0};
    const bool in_hole = std::any_of(holes.begin(), holes.end(), [&](const Outline& h) {
      const Vec3 from_middle = p - (h[0] + h[2]) * 0.5;
      return std::abs(from_middle.x) < 0.125 && std::abs(from_middle.y) < 0.125;
    });
    EXPECT_EQ(hits_of(sieve, {p + Vec3{0, 0, 1}, {0, 0, -1}}).empty(), in_hole)
        << p.x << ' ' << p.y;
  }
}

TEST(PolygonTest, HolesOfConcaveOutlines) {
  for (const Outline& outline : outlines()) {
    // A triangle a thousandth as large at the middle of each triangle of the outline.
    const Polygon whole(outline);
    const TriangleSoup soup = *whole.triangulate(100);
    std::vector<Outline> holes;
    double area = *whole.area();
    for (const auto& [a, b, c] : soup.triangles) {
      const Vec3 p = soup.points[a], q = soup.points[b], r = soup.points[c];
      const Vec3 middle = (p + q + r) / 3;
      holes.push_back({});
      for (const Vec3& v : {p, q, r}) holes.back().push_back(middle + (v - middle) * 1e-3);
      area -= 0.5e-6 * length(cross(q - p, r - p));
    }
    EXPECT_NEAR(*Polygon(outline, holes).area(), area, 1e-12);
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
  const auto message_of_hole = [](const std::vector<Outline>& holes) -> std::string {
    try {
      Polygon polygon(square(0, 0, 4), holes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message_of_hole({{{1, 1, 0}, {2, 1, 0}}}), HasSubstr("at least 3"));
  EXPECT_THAT(message_of_hole({square(5, 1, 1)}), HasSubstr("corner 4 lies outside the polygon"));
  EXPECT_THAT(message_of_hole({square(1, 1, 2), square(1.5, 1.5, 1)}),
              HasSubstr("corner 8 lies in another hole"));
  EXPECT_THAT(message_of_hole({square(3, 1, 2)}), HasSubstr("touch"));
  EXPECT_THAT(message_of_hole({square(1, 1, 1), square(2, 2, 1)}), HasSubstr("touch"));
}

}  // namespace
}  // namespace isolux
