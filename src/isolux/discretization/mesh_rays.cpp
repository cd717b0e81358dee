#include "isolux/discretization/mesh_rays.h"

#include <cstring>

#include "isolux/core/vectorize.h"

namespace isolux {
namespace {

TriangleCorners corners_of(const Triangulation& mesh, TriangleId id) {
  const auto& v = mesh.triangle(id).vertices;
  return {mesh.vertex(v[0]).position, mesh.vertex(v[1]).position, mesh.vertex(v[2]).position};
}

/// Spheres around triangles, coordinate by coordinate, so that one ray is held against many at
/// once.
struct BoundingSpheres {
  std::vector<float> x, y, z, radius_squared;

  void add(const TriangleCorners& c) {
    const Vec3 center = (c[0] + c[1] + c[2]) / 3;
    double r2 = 0;
    for (const Vec3& p : c) r2 = std::max(r2, length_squared(p - center));
    x.push_back(static_cast<float>(center.x));
    y.push_back(static_cast<float>(center.y));
    z.push_back(static_cast<float>(center.z));
    radius_squared.push_back(static_cast<float>(1.02 * r2));
  }
  void clear() { x.clear(), y.clear(), z.clear(), radius_squared.clear(); }
  std::size_t size() const { return x.size(); }
};

/// touched[i] = 1 where the line comes within sphere `first` + i, or, for rounding, hardly outside.
ISOLUX_VECTORIZE
void touch(const BoundingSpheres& spheres, std::size_t first, const Ray& ray,
           std::vector<std::uint8_t>& touched) {
  const Vec3 unit = normalized(ray.direction);
  const auto ox = static_cast<float>(ray.origin.x), oy = static_cast<float>(ray.origin.y),
             oz = static_cast<float>(ray.origin.z);
  const auto dx = static_cast<float>(unit.x), dy = static_cast<float>(unit.y),
             dz = static_cast<float>(unit.z);
  const float* x = spheres.x.data() + first;
  const float* y = spheres.y.data() + first;
  const float* z = spheres.z.data() + first;
  const float* r2 = spheres.radius_squared.data() + first;
  // Room for the rounding of single precision: (r + e)² ≤ 1.01 r² + 101 e², e = 4e-7 × distance.
  constexpr float kSlack = 1.6e-11f;
  const auto far = static_cast<float>(length_squared(ray.origin));
  const std::size_t n = spheres.size() - first;
  touched.resize(n);
  std::uint8_t* out = touched.data();
  for (std::size_t i = 0; i < n; ++i) {
    const float cx = x[i] - ox, cy = y[i] - oy, cz = z[i] - oz;
    const float mx = cy * dz - cz * dy, my = cz * dx - cx * dz, mz = cx * dy - cy * dx;
    out[i] = mx * mx + my * my + mz * mz <= r2[i] + kSlack * (far + cx * cx + cy * cy + cz * cz);
  }
}

}  // namespace

class MeshRays::Impl {
 public:
  explicit Impl(const Triangulation& triangulation) : mesh(triangulation), tree({}) {}

  void update() {
    const std::size_t n = mesh.triangles().size();
    for (std::size_t i = tree_end + young.size(); i < n; ++i) {
      young.add(corners_of(mesh, static_cast<TriangleId>(i)));
    }
    // A ray pays for each young triangle, a rebuild for each triangle: balanced near the root.
    if (young.size() * young.size() <= mesh.triangle_count() + 2048) return;
    TriangleSoup soup;
    for (const Vertex& vertex : mesh.vertices()) soup.points.push_back(vertex.position);
    ids.clear();
    for (TriangleId id = 0; id < n; ++id) {
      const Triangle& triangle = mesh.triangle(id);
      if (!triangle.alive) continue;
      ids.push_back(id);
      soup.triangles.push_back(triangle.vertices);
    }
    tree = TriangleTree(soup);
    tree_end = n;
    young.clear();
  }

  const Triangulation& mesh;
  TriangleTree tree;
  std::vector<TriangleId> ids;  // of the tree's triangles
  std::size_t tree_end = 0;     // triangles with smaller ids are in the tree, or dead
  BoundingSpheres young;        // of the triangles from tree_end on
};

MeshRays::MeshRays(const Triangulation& mesh) : impl_(std::make_unique<Impl>(mesh)) { update(); }
MeshRays::~MeshRays() = default;

void MeshRays::update() { impl_->update(); }

void MeshRays::hits_since(TriangleId first, const Ray& ray, Interval within,
                          std::vector<MeshHit>& hits) const {
  const Triangulation& mesh = impl_->mesh;
  const auto try_triangle = [&](TriangleId id) {
    if (!mesh.triangle(id).alive) return;
    const std::optional<double> t = intersect_triangle(corners_of(mesh, id), ray);
    if (t && *t > within.min && *t < within.max) hits.push_back({*t, id});
  };
  const std::size_t begin = std::max<std::size_t>(first, impl_->tree_end);
  const std::size_t listed = impl_->tree_end + impl_->young.size();
  if (begin < listed) {
    thread_local std::vector<std::uint8_t> touched;
    touch(impl_->young, begin - impl_->tree_end, ray, touched);
    // Few are touched: those that are not are passed by eight at a time.
    for (std::size_t i = 0; i < touched.size(); ++i) {
      std::uint64_t eight = 1;
      if (i + sizeof eight <= touched.size()) std::memcpy(&eight, &touched[i], sizeof eight);
      if (eight == 0) {
        i += sizeof eight - 1;
      } else if (touched[i]) {
        try_triangle(static_cast<TriangleId>(begin + i));
      }
    }
  }
  for (std::size_t i = std::max(begin, listed); i < mesh.triangles().size(); ++i) {
    try_triangle(static_cast<TriangleId>(i));
  }
}

void MeshRays::all_hits(const Ray& ray, Interval within, std::vector<MeshHit>& hits) const {
  all_hits({&ray, 1}, within, {&hits, 1});
}

void MeshRays::all_hits(std::span<const Ray> rays, Interval within,
                        std::span<std::vector<MeshHit>> hits) const {
  impl_->tree.all_hits(rays, within, hits);
  // As in there, reads of many rays in a row wait for memory together.
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (MeshHit& hit : hits[i]) hit.triangle = impl_->ids[hit.triangle];
    std::erase_if(hits[i],
                  [&](const MeshHit& hit) { return !impl_->mesh.triangle(hit.triangle).alive; });
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits_since(0, rays[i], within, hits[i]);
    std::sort(hits[i].begin(), hits[i].end(), [](const MeshHit& a, const MeshHit& b) {
      return std::pair(a.t, a.triangle) < std::pair(b.t, b.triangle);
    });
  }
}

}  // namespace isolux
