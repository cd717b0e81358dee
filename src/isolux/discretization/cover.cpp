#include "isolux/discretization/cover.h"

#include "isolux/core/error.h"
#include "isolux/core/parallel.h"
#include "isolux/discretization/connect.h"
#include "isolux/sampling/lines.h"

namespace isolux {
namespace {

// Lines through the whole scene, and through each object's own bounds.
constexpr std::size_t kLinesThroughScene = 2048;
constexpr std::size_t kLinesThroughObject = 64;
// Rays from each camera: cells a side of its picture.
constexpr int kEyeGrid = 48;

/// Adds what each camera sees, by one ray in each cell of its picture (§3.2.1).
void eye_pass(const SurfaceWalk& walk, std::uint64_t seed, std::vector<ZonePoint>& all) {
  const Scene& scene = walk.rays().scene();
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    Random random(seed, ~std::uint64_t{c});
    for (int cell = 0; cell < kEyeGrid * kEyeGrid; ++cell) {
      const double x = (cell % kEyeGrid + random.uniform()) / kEyeGrid;
      const double y = (cell / kEyeGrid + random.uniform()) / kEyeGrid;
      const Ray ray = scene.cameras[c].ray(x, y);
      const auto hit = walk.rays().nearest(ray);
      if (!hit || dot(hit->normal, ray.direction) >= 0) continue;
      if (const auto point = walk.at(*hit)) all.push_back(*point);
    }
  }
}

/// Points of all surfaces that light can reach, however small or hidden, or that a camera sees.
std::vector<ZonePoint> points_on_all_surfaces(const SurfaceWalk& walk, std::uint64_t seed) {
  const RayCaster& rays = walk.rays();
  const Scene& scene = rays.scene();
  const Bounds whole = scene.bounds();
  const std::size_t lines = kLinesThroughScene + kLinesThroughObject * scene.objects.size();
  std::vector<std::vector<ZonePoint>> found(lines);
  parallel_for(lines, 64, [&](std::size_t begin, std::size_t end) {
    std::vector<SurfaceHit> hits;
    for (std::size_t i = begin; i < end; ++i) {
      Random random(seed, i);
      std::optional<std::uint32_t> object;
      if (i >= kLinesThroughScene) {
        object = static_cast<std::uint32_t>((i - kLinesThroughScene) / kLinesThroughObject);
      }
      const Bounds bounds = object ? scene.objects[*object].shape->bounds() : whole;
      const Line line = random_line(bounds.center(), 0.5 * bounds.diagonal(), random);
      const Vec3 from = line.point - line.direction * whole.diagonal();
      rays.all_hits({from, line.direction}, {}, hits);
      for (const SurfaceHit& hit : hits) {
        if (object && hit.surface.object != *object) continue;
        if (const auto point = walk.at(hit)) found[i].push_back(*point);
      }
    }
  });
  std::vector<ZonePoint> all;
  for (const auto& points : found) all.insert(all.end(), points.begin(), points.end());
  eye_pass(walk, seed, all);
  return all;
}

/// Makes triangles of a cover's points, in an empty mesh.
class Weaver {
 public:
  Weaver(Triangulation& mesh, const CoverPoints& points, const SurfaceWalk& walk)
      : mesh_(mesh), points_(points), walk_(walk) {
    for (const CoverPoint& point : points.points()) {
      Vertex vertex;
      static_cast<SurfacePoint&>(vertex) = point;
      vertex.gather_point = point.position;
      mesh_.restore_vertex(std::move(vertex));
    }
  }

  void weave() {
    for (const StarTriangle& t : star_triangles(points_, walk_, mesh_.rules().max_edge)) {
      try_triangle(id(t.corners[0]), id(t.corners[1]), id(t.corners[2]), t.votes == 3);
    }
    mend();
    std::vector<std::pair<VertexId, VertexId>> edges;
    for (const Triangle& t : mesh_.triangles()) {
      if (!t.alive || t.on_light) continue;
      for (int k = 0; k < 3; ++k) {
        const VertexId a = t.vertices[k], b = t.vertices[(k + 1) % 3];
        if (a < b && !stretched(a) && !stretched(b)) edges.emplace_back(a, b);
      }
    }
    mesh_.make_delaunay(std::move(edges));
  }

 private:
  static VertexId id(std::uint32_t point) { return static_cast<VertexId>(point); }
  bool stretched(VertexId v) const { return point(v).stretch > 1; }
  const CoverPoint& point(VertexId v) const { return points_.points()[v]; }
  const Vec3& at(VertexId v) const { return mesh_.vertex(v).position; }

  bool try_triangle(VertexId a, VertexId b, VertexId c, bool agreed);
  bool sector_free(VertexId v, VertexId a, VertexId b) const;
  bool flat_along_crease(VertexId a, VertexId b, VertexId c) const;
  void mend();
  bool mend_at(VertexId a, VertexId b);

  Triangulation& mesh_;
  const CoverPoints& points_;
  const SurfaceWalk& walk_;
};

/// Whether the sector from va to vb overlaps no triangle around v, in v's tangent plane.
bool Weaver::sector_free(VertexId v, VertexId a, VertexId b) const {
  const Frame frame(mesh_.vertex(v).normal);
  const auto flat = [&](VertexId w) {
    const Vec3 d = at(w) - at(v);
    return std::pair(dot(d, frame.u), dot(d, frame.v));
  };
  const auto left = [](const std::pair<double, double>& p, const std::pair<double, double>& q) {
    return p.first * q.second - p.second * q.first;
  };
  const auto pa = flat(a), pb = flat(b);
  for (const TriangleId t : mesh_.vertex(v).triangles) {
    const auto& w = mesh_.triangle(t).vertices;
    const auto k = std::find(w.begin(), w.end(), v) - w.begin();
    const VertexId c = w[(k + 1) % 3], d = w[(k + 2) % 3];
    const auto pc = flat(c), pd = flat(d);
    const auto inside = [&](const auto& p, const auto& from, const auto& to) {
      return left(from, p) > 0 && left(p, to) > 0;
    };
    if (a == c || b == d) return false;
    if (a != d && inside(pa, pc, pd)) return false;
    if (b != c && inside(pb, pc, pd)) return false;
    if (c != b && inside(pc, pa, pb)) return false;
    if (d != a && inside(pd, pa, pb)) return false;
  }
  return true;
}

/// Whether all corners stand along one crease, and only the rounding of their places makes it a
/// triangle.
bool Weaver::flat_along_crease(VertexId a, VertexId b, VertexId c) const {
  constexpr double kFlat = 0.02;
  if (!point(a).on_crease() || !point(b).on_crease() || !point(c).on_crease()) return false;
  const double longest = std::max({length_squared(at(b) - at(a)), length_squared(at(c) - at(b)),
                                   length_squared(at(a) - at(c))});
  return length(cross(at(b) - at(a), at(c) - at(a))) < kFlat * longest;
}

bool Weaver::try_triangle(VertexId a, VertexId b, VertexId c, bool agreed) {
  if (mesh_.triangle_at(a, b) || mesh_.triangle_at(b, c) || mesh_.triangle_at(c, a)) return false;
  if (!mesh_.may_be_triangle(a, b, c) || flat_along_crease(a, b, c)) return false;
  if (!sector_free(a, b, c) || !sector_free(b, c, a) || !sector_free(c, a, b)) return false;
  if (!agreed && !(linked(point(a), point(b), walk_) && linked(point(b), point(c), walk_) &&
                   linked(point(c), point(a), walk_))) {
    return false;
  }
  if (!walk_.over(point(a), (at(a) + at(b) + at(c)) / 3)) return false;
  mesh_.restore_triangle({a, b, c}, point(a).emission, {}, false);
  return true;
}

/// Closes what the stars left open beside the edge ab, which has a triangle wound from a to b, with
/// the vertex that sees the edge under the largest angle; whether it did.
bool Weaver::mend_at(VertexId a, VertexId b) {
  const Vec3 normal = normalized(mesh_.vertex(a).normal + mesh_.vertex(b).normal);
  const Vec3 middle = (at(a) + at(b)) * 0.5, ab = at(b) - at(a);
  const Vec3 outward = normalized(cross(ab, normal));
  const double along = length(ab);
  ZonePoint from = point(a);
  from.position = middle;
  from.normal = normal;
  const double past = 0.12 * std::min(along, 2 * point(a).along(outward));
  if (!walk_.step(from, middle + outward * past)) return false;

  std::vector<std::uint32_t> ids;
  const double reach = 1.5 * std::max({along, point(a).longest(), point(b).longest()});
  points_.grid().query(point(a).surface.object, middle, reach, 8, ids);
  std::vector<std::pair<double, VertexId>> choices;
  for (const std::uint32_t other : ids) {
    const VertexId c = id(other);
    if (c == a || c == b || dot(at(c) - middle, outward) <= 1e-3 * point(a).along(outward))
      continue;
    const double angle =
        angle_between(point(a).squeezed(at(a) - at(c)), point(a).squeezed(at(b) - at(c)));
    if (angle > 0.1) choices.emplace_back(-angle, c);
  }
  std::sort(choices.begin(), choices.end());
  for (const auto& [angle, c] : choices) {
    if (try_triangle(b, a, c, false)) return true;
  }
  return false;
}

void Weaver::mend() {
  std::vector<std::pair<VertexId, VertexId>> open;
  const auto note = [&](const Triangle& t) {
    for (int k = 0; k < 3; ++k) {
      const VertexId a = t.vertices[k], b = t.vertices[(k + 1) % 3];
      if (!mesh_.triangle_at(b, a)) open.emplace_back(a, b);
    }
  };
  for (TriangleId t = 0; t < mesh_.triangles().size(); ++t) {
    note(mesh_.triangle(t));
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto [a, b] = open[i];
    if (mesh_.triangle_at(b, a) || !mesh_.triangle_at(a, b)) continue;
    const auto born = static_cast<TriangleId>(mesh_.triangles().size());
    if (mend_at(a, b)) note(mesh_.triangle(born));
  }
}

/// Puts the triangles of `woven` and their vertices into `mesh`; vertices without triangles, which
/// would only cost light to be gathered for, are left out.
void take_over(const Triangulation& woven, Triangulation& mesh) {
  std::vector<VertexId> ids(woven.vertices().size());
  for (VertexId v = 0; v < ids.size(); ++v) {
    if (!woven.vertex(v).triangles.empty()) ids[v] = mesh.restore_vertex(woven.vertex(v));
  }
  for (const Triangle& t : woven.triangles()) {
    const auto& v = t.vertices;
    if (t.alive) mesh.restore_triangle({ids[v[0]], ids[v[1]], ids[v[2]]}, t.emission, {}, false);
  }
}

}  // namespace

void cover(Triangulation& mesh, const RayCaster& rays, const CoverOptions& options) {
  if (!(options.spacing > 0) || !std::isfinite(options.spacing)) {
    throw InputError("the spacing of a cover must be a positive length");
  }
  const SurfaceWalk walk(rays, mesh.rules().normal_tolerance);
  const LightReach light(walk, options.seed);
  CoverPoints points(walk, light, std::min(options.spacing, 0.5 * mesh.rules().max_edge),
                     options.seed, options.keep_going);
  for (const ZonePoint& point : points_on_all_surfaces(walk, options.seed)) {
    points.grow_from(point);
  }
  points.settle();
  Triangulation woven(mesh.rules(), rays.scene().bounds());
  Weaver(woven, points, walk).weave();
  take_over(woven, mesh);
}

}  // namespace isolux
