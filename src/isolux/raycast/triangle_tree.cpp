#include "isolux/raycast/triangle_tree.h"

#include <algorithm>

#include "isolux/raycast/embree_device.h"

namespace isolux {
namespace {

/// Of a triangle: the points p with normal · p = offset. One cache line holds two.
struct alignas(32) Plane {
  Vec3 normal;
  double offset;
};

Plane plane_of(const TriangleCorners& corners) {
  const Vec3 normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
  return {normal, dot(normal, corners[0])};
}

/// What the filter needs to know of the ray on its way through the tree.
struct Query : RTCIntersectContext {
  std::vector<TriangleHit>* hits;
};

/// Takes every hit Embree finds into the list, and lets the ray go on.
void collect(const RTCFilterFunctionNArguments* args) {
  args->valid[0] = 0;
  static_cast<const Query*>(args->context)
      ->hits->push_back({0, RTCHitN_primID(args->hit, args->N, 0)});
}

}  // namespace

std::optional<double> intersect_triangle(const TriangleCorners& corners, const Ray& ray) {
  constexpr double kSlack = -1e-9;
  const Vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
  const Vec3 p = cross(ray.direction, e2);
  const double determinant = dot(e1, p);
  const Vec3 s = ray.origin - corners[0];
  const Vec3 q = cross(s, e1);
  const double w1 = dot(s, p) / determinant, w2 = dot(ray.direction, q) / determinant;
  // A determinant of zero makes weights that compare with nothing.
  if (!(w1 >= kSlack && w2 >= kSlack && 1 - w1 - w2 >= kSlack)) return std::nullopt;
  return dot(e2, q) / determinant;
}

struct TriangleTree::Impl {
  std::shared_ptr<RTCDeviceTy> device = embree_device();
  std::vector<Plane> planes;
  RTCScene scene = nullptr;

  ~Impl() { rtcReleaseScene(scene); }
};

TriangleTree::TriangleTree(const TriangleSoup& soup) : impl_(std::make_unique<Impl>()) {
  const auto& [vertices, triangles] = soup;
  impl_->planes.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    impl_->planes.push_back(plane_of({vertices[a], vertices[b], vertices[c]}));
  }
  RTCDevice device = impl_->device.get();
  impl_->scene = rtcNewScene(device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_LOW);
  if (!triangles.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               vertices.size()));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), triangles.size()));
    if (!points || !indices) throw std::bad_alloc();
    for (const Vec3& p : vertices) {
      for (int axis = 0; axis < 3; ++axis) *points++ = static_cast<float>(p[axis]);
    }
    for (const auto& corners : triangles) indices = std::copy_n(corners.begin(), 3, indices);
    rtcSetGeometryIntersectFilterFunction(geometry, collect);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(impl_->scene, geometry, 0);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(impl_->scene);
}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

void TriangleTree::all_hits(std::span<const Ray> rays, Interval within,
                            std::span<std::vector<TriangleHit>> hits) const {
  Query query;
  rtcInitIntersectContext(&query);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits[i].clear();
    query.hits = &hits[i];
    RTCRayHit rayhit = embree_ray(rays[i], within.max);
    rtcIntersect1(impl_->scene, &query, &rayhit);
  }
  // The planes lie all over memory: reads of many rays in a row wait for it together.
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (TriangleHit& hit : hits[i]) {
      const auto& [normal, offset] = impl_->planes[hit.triangle];
      hit.t = (offset - dot(normal, rays[i].origin)) / dot(normal, rays[i].direction);
    }
    std::erase_if(hits[i], [&](const TriangleHit& hit) {
      return !(hit.t > within.min && hit.t < within.max);
    });
  }
}

}  // namespace isolux
