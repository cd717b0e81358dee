#include <numbers>

#include "geometry/zoo.h"
#include "isolux/geometry/curve.h"
#include "isolux/geometry/height_field.h"
#include "isolux/geometry/prism.h"
#include "isolux/geometry/revolution.h"
#include "isolux/geometry/swept_sphere.h"

namespace isolux {
namespace {

using Outline = std::vector<Vec3>;

/// The distance of (x, y) from the outlines, negative within an odd number of them.
double outline_distance(const std::vector<Outline>& outlines, double x, double y) {
  const Vec3 p{x, y, 0};
  double least = 1e9;
  bool inside = false;
  for (const Outline& ring : outlines) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 a{ring[i].x, ring[i].y, 0};
      const Vec3 b{ring[(i + 1) % ring.size()].x, ring[(i + 1) % ring.size()].y, 0};
      const double t = std::clamp(dot(p - a, b - a) / length_squared(b - a), 0.0, 1.0);
      least = std::min(least, distance(p, a + (b - a) * t));
      if ((a.y > y) != (b.y > y)) inside ^= x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    }
  }
  return inside ? -least : least;
}

/// Of a prism over the plane z = 1.
Level prism_level(std::vector<Outline> outlines, Vec3 along, PrismTop top) {
  return [=](const Vec3& p) {
    const double z = (p.z - 1) / along.z, angle = top.twist * z * std::numbers::pi / 180;
    const double kx = 1 + (top.scale[0] - 1) * z, ky = 1 + (top.scale[1] - 1) * z;
    const double x = (p.x - top.center.x - along.x * z) / kx;
    const double y = (p.y - top.center.y - along.y * z) / ky;
    const double c = std::cos(angle), s = std::sin(angle);
    const double side =
        outline_distance(outlines, top.center.x + c * x + s * y, top.center.y + c * y - s * x);
    return std::max({side * std::min(kx, ky), 1 - p.z, p.z - 1 - along.z});
  };
}

void add_prisms(std::vector<Specimen>& zoo) {
  const Outline l = {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1.1, 1, 1}, {1.1, 3, 1}, {0, 3, 1}};
  const Outline hole = {{0.2, 0.2, 1}, {0.8, 0.2, 1}, {0.5, 2, 1}};
  const auto add = [&](const std::string& name, const Vec3& along, PrismTop top) {
    Outline corners = l;
    corners.insert(corners.end(), hole.begin(), hole.end());
    top.center.z = 1;
    zoo.push_back({name, std::make_shared<Prism>(l, std::vector<Outline>{hole}, along, top),
                   prism_level({l, hole}, along, top), corners});
  };
  add("Prism", {0, 0, 1.5}, {});
  add("LeaningPrism", {0.7, -0.4, 1.5}, {});
  add("TaperedPrism", {0.7, -0.4, 1.5}, {{1, 1, 1}, {0.3, 0.3}});
  add("Steeple", {0, 0, 2}, {{1, 1, 1}, {0, 0}});
  add("RuledPrism", {0, 0, 2}, {{1, 1, 1}, {0.5, 1.5}});
  add("TwistedPrism", {0, 0, 2}, {{1, 1, 1}, {1, 1}, 200});
  add("LeaningTwistedPrism", {0.5, 0.2, 2}, {{0, 0, 1}, {0.4, 0.8}, -90});
  const Outline clockwise(l.rbegin(), l.rend());
  const Vec3 down{0, 0, -1.5};
  zoo.push_back({"PrismBelow", std::make_shared<Prism>(clockwise, std::vector<Outline>{}, down),
                 [l](const Vec3& p) {
                   return std::max({outline_distance({l}, p.x, p.y), p.z - 1, -0.5 - p.z});
                 }});
}

/// The signed distance in the half plane of a profile, r and z as x and y: from its outline with
/// its mirror image beyond the axis.
Level polygon_profile(std::vector<ProfilePoint> profile) {
  Outline outline;
  for (const auto& [r, z] : profile) outline.push_back({r, z, 0});
  if (profile.front()[0] == 0 && profile.back()[0] == 0) {
    for (std::size_t i = profile.size() - 1; i-- > 1;) {
      outline.push_back({-profile[i][0], profile[i][1], 0});
    }
  }
  return [=](const Vec3& p) { return outline_distance({outline}, p.x, p.y); };
}

/// The same for a curve (x, 0, z) with its inside on the left: by the nearest of many places on it,
/// improved by Newton's method.
Level curved_profile(std::vector<CurveArc> arcs) {
  return [=](const Vec3& q) {
    const Vec3 p{q.x, 0, q.y};
    double nearest = 1e9, level = 0;
    for (const CurveArc& arc : arcs) {
      const auto at = [&](double u, int order) {
        const double v = 1 - u;
        const auto& [a, b, c, d] = arc;
        if (order == 0) {
          return a.p * (v * v * v) + b.p * (3 * v * v * u) + c.p * (3 * v * u * u) +
                 d.p * (u * u * u);
        }
        const Vec3 e = (b.p - a.p) * 3, f = (c.p - b.p) * 3, g = (d.p - c.p) * 3;
        if (order == 1) return e * (v * v) + f * (2 * v * u) + g * (u * u);
        return (f - e) * (2 * v) + (g - f) * (2 * u);
      };
      double best = 0;
      for (double u = 0; u <= 1; u += 1.0 / 64) {
        if (distance(at(u, 0), p) < distance(at(best, 0), p)) best = u;
      }
      for (int i = 0; i < 20; ++i) {
        const Vec3 away = at(best, 0) - p, slope = at(best, 1);
        best -= dot(away, slope) / (length_squared(slope) + dot(away, at(best, 2)));
        best = std::clamp(best, 0.0, 1.0);
      }
      const Vec3 away = p - at(best, 0), slope = at(best, 1);
      if (length(away) < nearest) {
        nearest = length(away);
        level = slope.z * away.x - slope.x * away.z > 0 ? nearest : -nearest;
      }
    }
    return level;
  };
}

/// Of a profile turned about the axis x = 1, y = 2, from x on.
Level revolution_level(Level profile, double degrees = 360) {
  return [=](const Vec3& p) {
    const double x = p.x - 1, y = p.y - 2, a = degrees * std::numbers::pi / 180;
    const double level = profile({std::hypot(x, y), p.z, 0});
    if (degrees == 360) return level;
    const double start = -y, end = std::cos(a) * y - std::sin(a) * x;
    return std::max(level, degrees <= 180 ? std::max(start, end) : std::min(start, end));
  };
}

void add_revolutions(std::vector<Specimen>& zoo) {
  const auto add = [&](const std::string& name, const std::vector<ProfilePoint>& profile,
                       const RevolutionForm& form, const Level& level) {
    std::vector<Vec3> edges;
    for (const auto& [r, z] : profile) {
      if (form.smooth) break;
      for (const Vec3& p : rim({1, 2, z}, {0, 0, 1}, r)) edges.push_back(p);
    }
    zoo.push_back({name + "Revolution",
                   std::make_shared<Revolution>(Vec3{1, 2, 0}, Vec3{0, 0, 1}, profile, form),
                   revolution_level(level, form.angle), edges});
  };
  const std::vector<ProfilePoint> ring = {{0.5, 0}, {1.5, 0}, {1.5, 0.3},
                                          {0.8, 1}, {1, 2},   {0.5, 2}};
  const std::vector<ProfilePoint> top = {{0, 0}, {1, 0.2}, {1, 1}, {0.3, 1}, {0, 2}};
  add("Ring", ring, {}, polygon_profile(ring));
  add("Top", top, {}, polygon_profile(top));
  add("ThirdRing", ring, {.angle = 120}, polygon_profile(ring));
  add("LargeTop", top, {.angle = 250}, polygon_profile(top));

  const auto curve_points = [](const std::vector<ProfilePoint>& profile) {
    std::vector<CurvePoint> points;
    for (const auto& [r, z] : profile) points.push_back({{r, 0, z}});
    return points;
  };
  const std::vector<ProfilePoint> pear = {{0, 0}, {0.9, 0.4}, {1, 1}, {0.4, 1.8}, {0, 2.2}};
  const auto mirrored = [](CurvePoint point) {
    point.p.x = -point.p.x;
    return point;
  };
  auto points = curve_points(pear);
  add("Pear", pear, {.smooth = true},
      curved_profile(curve_through(points, mirrored(points[1]), mirrored(points[3]))));
  add("HalfPear", pear, {.angle = 180, .smooth = true},
      curved_profile(curve_through(points, mirrored(points[1]), mirrored(points[3]))));
  const std::vector<ProfilePoint> tyre = {{1, 0}, {1.5, 0.2}, {1.6, 1}, {0.9, 1.1}, {0.7, 0.4}};
  points = curve_points(tyre);
  points.push_back(points.front());
  add("Tyre", tyre, {.smooth = true}, curved_profile(curve_through(points, points[4], points[1])));
  const std::vector<ProfilePoint> shade = {{0.3, 2}, {0.4, 1.5}, {1, 1.1}, {1.2, 0.4}};
  points = curve_points(shade);
  const Level turned_over = curved_profile(
      curve_through(points, straight_on(points[0], points[1]), straight_on(points[3], points[2])));
  add("Shade", shade, {.smooth = true, .open = true}, turned_over);
  add("Funnel", {{1.5, 2}, {0.5, 1}, {0.5, 0}}, {.angle = 300, .open = true},
      polygon_profile({{1.5, 2}, {0.5, 1}, {0.5, 0}, {9, 0}, {9, 2}}));
}

CurvePoint place_on(const CurveArc& arc, double u) {
  const double v = 1 - u;
  const std::array<double, 4> w = {v * v * v, 3 * v * v * u, 3 * v * u * u, u * u * u};
  CurvePoint point;
  for (std::size_t i = 0; i < 4; ++i) {
    point.p += arc[i].p * w[i];
    point.radius += arc[i].radius * w[i];
  }
  return point;
}

/// How far a point is from the nearest of the balls: the least by golden sections around the best
/// of many places.
Level sweep_level(std::vector<CurveArc> arcs) {
  return [=](const Vec3& p) {
    double least = 1e9;
    for (const CurveArc& arc : arcs) {
      const auto gap = [&](double u) {
        const CurvePoint ball = place_on(arc, u);
        return distance(p, ball.p) - ball.radius;
      };
      constexpr double kStep = 1.0 / 64;
      double best = 0;
      for (double u = 0; u <= 1; u += kStep) {
        if (gap(u) < gap(best)) best = u;
      }
      double a = std::max(0.0, best - kStep), b = std::min(1.0, best + kStep);
      const double golden = (std::sqrt(5.0) - 1) / 2;
      for (int i = 0; i < 60; ++i) {
        const double c = b - golden * (b - a), d = a + golden * (b - a);
        (gap(c) < gap(d) ? b : a) = gap(c) < gap(d) ? d : c;
      }
      least = std::min({least, gap(0.5 * (a + b)), gap(0), gap(1)});
    }
    return least;
  };
}

void add_sweeps(std::vector<Specimen>& zoo) {
  const auto add = [&](const std::string& name, const std::vector<CurvePoint>& points, bool loop) {
    auto path = points;
    if (loop) path.push_back(points.front());
    const std::size_t n = points.size();
    const auto before = loop ? points[n - 1] : straight_on(points[0], points[1]);
    const auto after = loop ? points[1] : straight_on(points[n - 1], points[n - 2]);
    zoo.push_back({name, std::make_shared<SweptSphere>(points, loop),
                   sweep_level(curve_through(path, before, after))});
  };
  add("Horn", {{{0, 0, 0}, 0.1}, {{1, 0, 0.5}, 0.2}, {{1.5, 1, 1}, 0.5}, {{0.5, 2, 1.5}, 0.9}},
      false);
  add("Wire", {{{0, 0, 0}, 0.02}, {{1, 1, 0}, 0.02}, {{2, 0, 0.5}, 0.02}, {{3, 0, 2}, 0.02}},
      false);
  add("Capsule", {{{0, 0, 1}, 0.4}, {{2, 1, 1}, 0.4}}, false);
  add("Bead", {{{0, 0, 1}, 0.3}, {{0.1, 0, 1}, 0.9}, {{1, 0, 1}, 0.3}}, false);
  add("Knot",
      {{{1, 0, 0.4}, 0.2},
       {{-0.5, 0.9, -0.4}, 0.25},
       {{-0.5, -0.9, 0.4}, 0.2},
       {{2, 0, -0.4}, 0.3},
       {{-1, 1.8, 0.4}, 0.2}},
      true);
}

/// Hills over [0, 2] × [0, 3], their level along z.
void add_height_field(std::vector<Specimen>& zoo) {
  constexpr int kColumns = 20, kRows = 15;
  std::vector<std::vector<double>> heights(kRows + 1);
  for (int j = 0; j <= kRows; ++j) {
    for (int i = 0; i <= kColumns; ++i) {
      heights[static_cast<std::size_t>(j)].push_back(0.4 * std::sin(0.7 * i) * std::cos(0.5 * j));
    }
  }
  const auto at = [heights](int i, int j) {
    return heights[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
  };
  const Level level = [=](const Vec3& p) {
    const double x = p.x / 2 * kColumns, y = p.y / 3 * kRows;
    const int i = std::clamp(static_cast<int>(std::floor(x)), 0, kColumns - 1);
    const int j = std::clamp(static_cast<int>(std::floor(y)), 0, kRows - 1);
    const double a = x - i, b = y - j;
    const double height = a + b <= 1 ? (1 - a - b) * at(i, j) + a * at(i + 1, j) + b * at(i, j + 1)
                                     : (a + b - 1) * at(i + 1, j + 1) + (1 - b) * at(i + 1, j) +
                                           (1 - a) * at(i, j + 1);
    return p.z - height;
  };
  zoo.push_back({"HeightField",
                 std::make_shared<HeightField>(Vec3{}, Vec3{2, 0, 0}, Vec3{0, 3, 0}, heights),
                 level});
}

}  // namespace

void add_swept(std::vector<Specimen>& zoo) {
  add_prisms(zoo);
  add_revolutions(zoo);
  add_sweeps(zoo);
  add_height_field(zoo);
}

}  // namespace isolux
