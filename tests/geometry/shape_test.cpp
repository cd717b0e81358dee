#include "isolux/geometry/shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/zoo.h"

namespace isolux {
namespace {

constexpr double kRounding = 1e-12;

class ShapeTest : public testing::TestWithParam<Specimen> {
 protected:
  const Shape& shape() const { return *GetParam().shape; }
  double level(const Vec3& p) const { return GetParam().level(p); }

  /// Lines through the neighbourhood of the shape, their origins that far away.
  template <typename F>
  void for_random_lines(int count, double distance, F&& check) {
    Random random(7);
    const Bounds box = shape().bounds();
    for (int i = 0; i < count; ++i) {
      check(random_line(random, box.center(), 0.55 * box.diagonal(), distance));
      if (HasFailure()) return;
    }
  }

  void expect_alternating(const Ray& ray, const Hits& hits) const {
    if (!shape().solid()) return;
    ASSERT_EQ(hits.size() % 2, 0u);
    bool inside = shape().unbounded();
    for (const Hit& hit : hits) {
      EXPECT_EQ(dot(hit.normal, ray.direction) > 0, inside) << "at t = " << hit.t;
      inside = !inside;
    }
  }

  /// Membership between the hits; `margin` is the depth that counts as clearly in or out.
  void expect_parity(const Ray& ray, const Hits& hits, double margin) const {
    bool inside = shape().unbounded();
    double before = hits.empty() ? 0 : hits.front().t - 1;
    for (const Hit& hit : hits) {
      const Vec3 middle = ray.at(0.5 * (before + hit.t));
      if (std::abs(level(middle)) > margin) {
        EXPECT_EQ(shape().contains(middle), inside) << "before t = " << hit.t;
        EXPECT_EQ(level(middle) < 0, inside) << "before t = " << hit.t;
      }
      before = hit.t;
      inside = !inside;
    }
  }
};

TEST_P(ShapeTest, HitsLieOnTheSurfaceAndOnTheLine) {
  std::size_t count = 0;
  for_random_lines(3000, 5, [&](const Ray& ray) {
    double before = -std::numeric_limits<double>::infinity();
    for (const Hit& hit : hits_of(shape(), ray)) {
      EXPECT_NEAR(level(hit.point), 0, 10 * kRounding);
      // A grazing line, and one through a fine tube, are less well determined.
      EXPECT_LT(distance(hit.point, ray.at(hit.t)), 1e-9);
      EXPECT_GE(hit.t, before);
      EXPECT_LT(hit.face, shape().face_count());
      before = hit.t;
      ++count;
    }
  });
  EXPECT_GT(count, 20u);
}

TEST_P(ShapeTest, OccludesManySegmentsAsEachByItself) {
  constexpr double kEnd = 0.999;
  SegmentBlock block;
  std::size_t lane = 0, blocked_count = 0, count = 0;
  const auto ask = [&](const Ray& ray) {
    block.set(lane++, ray);
    if (lane < SegmentBlock::kLanes) return;
    lane = 0;
    SegmentBlock::Mask blocked{};
    blocked[3] = 1;
    shape().occlude(block, kEnd, blocked);
    EXPECT_EQ(blocked[3], 1) << "what is blocked stays so";
    for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) {
      if (i == 3) continue;
      EXPECT_EQ(blocked[i], shape().occludes(block.ray(i), 0, kEnd)) << "segment " << count;
      blocked_count += blocked[i];
      ++count;
    }
  };
  Random random(11);
  for_random_lines(4000, 2, [&](const Ray& line) {
    const Ray ray{line.origin, line.direction * (6 * random.uniform())};
    ask(ray);
    // Along the axes and their planes as well, where formulas divide by nothing.
    Ray special = ray;
    special.direction[static_cast<int>(random.below(3))] = 0;
    ask(special);
    special.direction[static_cast<int>(random.below(3))] = 0;
    ask(special);
  });
  for (const Vec3& edge : GetParam().edges) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 step;
      step[axis] = 1;
      ask({edge - step * 0.5, step}), ask({edge, step});
    }
  }
  EXPECT_GT(blocked_count, 20u);
  EXPECT_LT(blocked_count, count);
}

TEST_P(ShapeTest, NormalsAreUnitGradients) {
  constexpr double h = 1e-6;
  std::size_t checked = 0, skipped = 0;
  for_random_lines(1000, 5, [&](const Ray& ray) {
    for (const Hit& hit : hits_of(shape(), ray)) {
      EXPECT_NEAR(length(hit.normal), 1, kRounding);
      Vec3 forward, backward;
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 step;
        step[axis] = h;
        forward[axis] = (level(hit.point + step) - level(hit.point)) / h;
        backward[axis] = (level(hit.point) - level(hit.point - step)) / h;
      }
      if (distance(forward, backward) > 1e-3) {  // beside an edge
        ++skipped;
        continue;
      }
      ++checked;
      EXPECT_LT(distance(normalized(forward + backward), hit.normal), 1e-5);
    }
  });
  EXPECT_LT(skipped, 0.02 * static_cast<double>(checked));
}

TEST_P(ShapeTest, SolidsAreEnteredAndLeftInTurn) {
  for_random_lines(3000, 5, [&](const Ray& ray) {
    const Hits hits = hits_of(shape(), ray);
    expect_alternating(ray, hits);
    if (shape().solid()) expect_parity(ray, hits, 1e-9);
  });
}

TEST_P(ShapeTest, EdgesCornersAndTangentsKeepTheOrder) {
  Random random(11);
  const auto check = [&](const Ray& ray) {
    const Hits hits = hits_of(shape(), ray);
    if (!shape().solid()) return;
    ASSERT_EQ(hits.size() % 2, 0u);
    expect_parity(ray, hits, 1e-9);
    for (const Hit& hit : hits) EXPECT_NEAR(level(hit.point), 0, 10 * kRounding);
  };
  for (const Vec3& edge : GetParam().edges) {
    for (int i = 0; i < 26; ++i) {
      const Vec3 d{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
      if (d != Vec3{}) check({edge - d * 2, d});
    }
    for (int i = 0; i < 100; ++i) {
      const Vec3 d = random_direction(random);
      check({edge - d * (10 * random.uniform()), d});
    }
    for (const Vec3& other : GetParam().edges) {
      if (other != edge) check({edge + (edge - other) * 1.7, other - edge});
    }
  }
  for_random_lines(300, 5, [&](const Ray& ray) {
    for (const Hit& hit : hits_of(shape(), ray)) {
      const Vec3 tangent = cross(hit.normal, random_direction(random));
      check({hit.point - tangent * 3, tangent});
    }
  });
}

TEST_P(ShapeTest, LinesFromFarAwayMeetTheSamePoints) {
  const double size = shape().bounds().diagonal();
  for_random_lines(1000, 1e4 * size, [&](const Ray& far) {
    const Ray near{far.at(1e4 * size - 5), far.direction};
    const Hits a = hits_of(shape(), far), b = hits_of(shape(), near);
    if (a.size() != b.size()) {  // only where the line grazes
      const Hits& more = a.size() > b.size() ? a : b;
      const auto sharpness = [&](const Hit& h) { return std::abs(dot(h.normal, far.direction)); };
      double least = 1;
      for (const Hit& h : more) least = std::min(least, sharpness(h));
      EXPECT_LT(least, 1e-4);
      return;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(level(a[i].point), 0, 10 * kRounding);
      const double sharpness = std::abs(dot(a[i].normal, far.direction));
      EXPECT_LT(distance(a[i].point, b[i].point), 1e-10 * size / std::max(1e-3, sharpness));
    }
  });
}

TEST_P(ShapeTest, BoundsHoldEveryHit) {
  const Bounds box = shape().bounds();
  const Vec3 slack = Vec3{1, 1, 1} * (kRounding * box.diagonal());
  Bounds met;
  for_random_lines(3000, 5, [&](const Ray& ray) {
    for (const Hit& hit : hits_of(shape(), ray)) met.include(hit.point);
  });
  EXPECT_EQ(max(met.upper, box.upper + slack), box.upper + slack);
  EXPECT_EQ(min(met.lower, box.lower - slack), box.lower - slack);
}

TEST_P(ShapeTest, OccludesAsItIntersects) {
  Random random(3);
  for_random_lines(1000, 5, [&](const Ray& ray) {
    const Hits hits = hits_of(shape(), ray);
    const double t_min = 10 * random.uniform(), t_max = t_min + 5 * random.uniform();
    bool expected = false;
    for (const Hit& h : hits) expected |= h.t > t_min && h.t < t_max;
    EXPECT_EQ(shape().occludes(ray, t_min, t_max), expected);
    for (const Hit& h : hits) {
      EXPECT_TRUE(shape().occludes(ray, h.t - 1e-6, h.t + 1e-6));
      // The ends of the interval do not count.
      if (hits.size() == 1) {
        EXPECT_FALSE(shape().occludes(ray, h.t, h.t + 1));
      }
    }
  });
}

TEST_P(ShapeTest, PartsTogetherAreTheShape) {
  const auto times = [](const Hits& hits) {
    std::vector<double> t;
    for (const Hit& h : hits) t.push_back(h.t);
    std::sort(t.begin(), t.end());
    return t;
  };
  for_random_lines(500, 5, [&](const Ray& ray) {
    Hits all;
    for (std::size_t part = 0; part < shape().part_count(); ++part) {
      const std::size_t first = all.size();
      shape().intersect_part(part, ray, all);
      const Bounds box = shape().part_bounds(part);
      for (std::size_t i = first; i < all.size(); ++i) {
        EXPECT_LT(length(all[i].point - max(box.lower, min(box.upper, all[i].point))), 1e-12);
        EXPECT_TRUE(shape().part_occludes(part, ray, all[i].t - 1e-6, all[i].t + 1e-6));
      }
      if (all.size() == first) {
        EXPECT_FALSE(shape().part_occludes(part, ray, -100, 100));
      }
    }
    EXPECT_EQ(times(all), times(hits_of(shape(), ray)));
  });
}

TEST_P(ShapeTest, BrokenRaysMeetNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, nan, inf}) {
    const Vec3 center = shape().bounds().center();
    EXPECT_TRUE(hits_of(shape(), {center, Vec3{1, 1, 1} * bad}).empty());
    if (bad == 0) continue;
    EXPECT_TRUE(hits_of(shape(), {Vec3{bad, 0, 0}, {1, 2, 3}}).empty());
    EXPECT_FALSE(shape().occludes({Vec3{bad, 0, 0}, {1, 2, 3}}, 0, 10));
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, ShapeTest, testing::ValuesIn(zoo()),
                         [](const auto& specimen) { return specimen.param.name; });

}  // namespace
}  // namespace isolux
