#include "isolux/geometry/triangle_mesh.h"

#include <fmt/format.h>

#include "isolux/core/error.h"
#include "isolux/geometry/mesh_topology.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {

// A line meets a triangle where, seen along the line, the triangle's corners run around it. The
// corners' places beside the line are the same for all triangles that share them, and the tests
// below are exact on those places, a line through an edge being moved aside by an infinitely small
// step that is the same for all triangles (simulation of simplicity, Edelsbrunner and Mücke 1990).
// So a line enters a closed mesh exactly as often as it leaves it. The shear is that of Woop,
// Benthin and Wald 2013.

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// The sign of a.x b.y − a.y b.x, exact but for underflow.
int cross_sign(const Vec3& a, const Vec3& b) {
  const double left = a.x * b.y, right = a.y * b.x;
  if (left != right) return left > right ? 1 : -1;
  const double left_rest = std::fma(a.x, b.y, -left), right_rest = std::fma(a.y, b.x, -right);
  return (left_rest > right_rest) - (left_rest < right_rest);
}

/// On which side of the directed edge a b the origin lies, 1 for the left, the origin being moved
/// by (ε, ε²); 0 where a and b are the same place.
int edge_side(const Vec3& a, const Vec3& b) {
  if (const int sign = cross_sign(a, b)) return sign;
  if (a.y != b.y) return a.y > b.y ? 1 : -1;
  return (b.x > a.x) - (b.x < a.x);
}

/// Marks, in Hit::face, a hit where the line leaves through the triangle's outer side. It is told
/// by the exact test, not by the normal, so that entries and leaves balance.
constexpr std::uint32_t kLeaves = 1u << 31;

/// Keeps of a closed mesh's marked hits (sorted, from `first` on) those where the line passes
/// between outside and inside, counting how many times over it is inside.
void keep_boundary(Hits& hits, std::size_t first, int times_inside) {
  std::size_t kept = first;
  for (std::size_t i = first; i < hits.size(); ++i) {
    const bool was_inside = times_inside > 0;
    times_inside += (hits[i].face & kLeaves) ? -1 : 1;
    if (was_inside != (times_inside > 0)) hits[kept++] = hits[i];
  }
  hits.resize(kept);
}

}  // namespace

/// A line, and the shear that makes it the z axis.
struct TriangleMesh::Line {
  Vec3 origin, direction;
  double shift;  ///< t at the origin
  int x, y, z;   ///< which axes become x, y and z
  double shear_x, shear_y, per_z;

  /// (x, y) the place beside the line, z the distance along it in lengths of the direction.
  Vec3 place(const Vec3& p) const {
    const Vec3 q = p - origin;
    return {q[x] - shear_x * q[z], q[y] - shear_y * q[z], q[z] * per_z};
  }
};

TriangleMesh::TriangleMesh(std::vector<Vec3> points, std::vector<Corners> triangles)
    : soup_{std::move(points), std::move(triangles)} {
  constexpr std::size_t kMost = 1u << 30;
  if (soup_.triangles.empty()) throw InputError("triangles: a mesh needs at least one");
  if (soup_.triangles.size() > kMost || soup_.points.size() > kMost) {
    throw InputError(fmt::format("triangles: a mesh has at most {}; cut it into several", kMost));
  }
  for (std::size_t i = 0; i < soup_.points.size(); ++i) {
    require_point(soup_.points[i], fmt::format("points[{}]", i));
  }
  normals_.reserve(soup_.triangles.size());
  for (std::size_t i = 0; i < soup_.triangles.size(); ++i) {
    for (const std::uint32_t corner : soup_.triangles[i]) {
      if (corner < soup_.points.size()) continue;
      throw InputError(fmt::format("triangles[{}]: there is no point {}; the last one is {}", i,
                                   corner, static_cast<long long>(soup_.points.size()) - 1));
    }
    const Bounds box = part_bounds(i);
    const auto [a, b, c] = soup_.triangles[i];
    const Vec3 n = cross(soup_.points[b] - soup_.points[a], soup_.points[c] - soup_.points[a]);
    const double size = box.diagonal();
    if (!(length(n) > 1e-12 * size * size) || !(size > kShortestLength)) {
      throw InputError(fmt::format("triangles[{}]: has no area; leave it out", i));
    }
    normals_.push_back(normalized(n));
    bounds_.include(box);
  }
  area_ = isolux::area(soup_);
  double volume = 0;
  const Vec3 center = bounds_.center();
  for (const auto& [a, b, c] : soup_.triangles) {
    volume +=
        dot(soup_.points[a] - center, cross(soup_.points[b] - center, soup_.points[c] - center)) /
        6;
  }
  constexpr double kFlat = 1e-3;  // rad
  MeshTopology topology = find_topology(soup_, normals_, kFlat);
  faces_ = std::move(topology.faces);
  face_count_ = topology.face_count;
  solid_ = topology.closed && std::abs(volume) > 1e-15 * std::pow(bounds_.diagonal(), 3);
  unbounded_ = solid_ && volume < 0;
}

TriangleMesh::Line TriangleMesh::line(const Ray& ray) const {
  Line line;
  line.direction = ray.direction;
  line.shift = dot(bounds_.center() - ray.origin, ray.direction) / length_squared(ray.direction);
  line.origin = ray.at(line.shift);
  const Vec3& d = ray.direction;
  const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  line.z = az >= ax && az >= ay ? 2 : ay >= ax ? 1 : 0;
  line.x = (line.z + 1) % 3;
  line.y = (line.z + 2) % 3;
  line.shear_x = d[line.x] / d[line.z];
  line.shear_y = d[line.y] / d[line.z];
  line.per_z = 1 / d[line.z];
  return line;
}

std::optional<Hit> TriangleMesh::hit(std::size_t part, const Line& line) const {
  const auto [a, b, c] = soup_.triangles[part];
  const Vec3 &pa = soup_.points[a], &pb = soup_.points[b], &pc = soup_.points[c];
  const Vec3 qa = line.place(pa), qb = line.place(pb), qc = line.place(pc);
  const int turn = edge_side(qa, qb);
  if (turn == 0 || edge_side(qb, qc) != turn || edge_side(qc, qa) != turn) return std::nullopt;
  // Weights of the corners; rounding can make them all vanish where the triangle is edge-on.
  double wa = std::abs(cross(qb, qc).z), wb = std::abs(cross(qc, qa).z);
  double wc = std::abs(cross(qa, qb).z);
  const double sum = wa + wb + wc;
  if (sum > 0) {
    wa /= sum, wb /= sum, wc /= sum;
  } else {
    wa = wb = wc = 1.0 / 3;
  }
  const double t = line.shift + wa * qa.z + wb * qb.z + wc * qc.z;
  if (!std::isfinite(t)) return std::nullopt;
  const bool leaves = (turn > 0) == (line.direction[line.z] > 0);
  return Hit{t, pa * wa + pb * wb + pc * wc, normals_[part], faces_[part] | (leaves ? kLeaves : 0)};
}

const BoxTree& TriangleMesh::tree() const {
  std::call_once(tree_made_, [&] {
    // Room for the rounding of the tests below.
    const double room =
        1e-9 * bounds_.diagonal() + 1e-14 * (length(bounds_.lower) + length(bounds_.upper));
    std::vector<Bounds> boxes(part_count());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Bounds box = part_bounds(i);
      boxes[i] = {box.lower - Vec3{1, 1, 1} * room, box.upper + Vec3{1, 1, 1} * room};
    }
    tree_ = std::make_unique<BoxTree>(boxes);
  });
  return *tree_;
}

template <typename Visit>
bool TriangleMesh::any_hit(const Line& line, const Visit& visit) const {
  constexpr std::size_t kFew = 16;
  const auto ask = [&](std::size_t part) {
    const auto h = hit(part, line);
    return h && visit(*h);
  };
  if (part_count() > kFew)
    return tree().any(
        [&](const Bounds& box) {
          return meets({line.origin, line.direction}, box);
        },
        ask);
  for (std::size_t part = 0; part < part_count(); ++part) {
    if (ask(part)) return true;
  }
  return false;
}

void TriangleMesh::intersect(const Ray& ray, Hits& hits) const {
  const std::size_t first = hits.size();
  any_hit(line(ray), [&](const Hit& hit) {
    hits.push_back(hit);
    return false;
  });
  std::sort(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(),
            [](const Hit& a, const Hit& b) { return a.t < b.t; });
  if (solid_) keep_boundary(hits, first, unbounded_ ? 1 : 0);
  for (std::size_t i = first; i < hits.size(); ++i) hits[i].face &= ~kLeaves;
}

bool TriangleMesh::occludes(const Ray& ray, double t_min, double t_max) const {
  return any_hit(line(ray), [&](const Hit& hit) { return hit.t > t_min && hit.t < t_max; });
}

bool TriangleMesh::contains(const Vec3& point) const {
  if (!solid_) return false;
  if (!unbounded_ && !bounds_.encloses({point, point})) return false;
  int times_inside = unbounded_ ? 1 : 0;
  const Ray ray{point, {0.3141, 0.2718, 0.9097}};  // any direction will do
  any_hit(line(ray), [&](const Hit& hit) {
    if (hit.t > 0) times_inside += (hit.face & kLeaves) ? 1 : -1;
    return false;
  });
  return times_inside > 0;
}

std::optional<TriangleSoup> TriangleMesh::triangulate(double max_edge) const {
  // Points are shared within a face alone.
  TriangleSoup soup;
  std::vector<std::array<std::uint32_t, 3>> keys;  // face, old point, new point
  for (std::size_t i = 0; i < part_count(); ++i) {
    for (const std::uint32_t corner : soup_.triangles[i]) keys.push_back({faces_[i], corner, 0});
  }
  auto sorted = keys;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (auto& key : sorted) {
    key[2] = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(soup_.points[key[1]]);
  }
  soup.triangles.resize(part_count());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    soup.triangles[i / 3][i % 3] = (*std::lower_bound(sorted.begin(), sorted.end(), keys[i]))[2];
  }
  subdivide(soup, max_edge);
  return soup;
}

Bounds TriangleMesh::part_bounds(std::size_t part) const {
  Bounds box;
  for (const std::uint32_t corner : soup_.triangles[part]) box.include(soup_.points[corner]);
  return box;
}

void TriangleMesh::intersect_part(std::size_t part, const Ray& ray, Hits& hits) const {
  if (const auto h = hit(part, line(ray))) {
    hits.push_back(*h);
    hits.back().face &= ~kLeaves;
  }
}

bool TriangleMesh::part_occludes(std::size_t part, const Ray& ray, double t_min,
                                 double t_max) const {
  const auto h = hit(part, line(ray));
  return h && h->t > t_min && h->t < t_max;
}

ShapeDescription TriangleMesh::describe() const {
  return {"mesh", {{"points", soup_.points}, {"triangles", soup_.triangles}}, {}, {}};
}

}  // namespace isolux
