#include "isolux/raycast/triangle_tree.h"

#include <algorithm>

#include "isolux/raycast/embree_device.h"

namespace isolux {
namespace {

/// What the filter needs to know of the ray on its way through the tree.
struct Query : RTCIntersectContext {
  const Ray* ray;
  Interval within;
  const TriangleSoup* soup;
  std::vector<TriangleHit>* hits;
};

/// t and barycentric weights of the line in the triangle's plane; false where it lies in it.
bool intersect_plane(const TriangleCorners& corners, const Ray& ray, TriangleHit& hit) {
  const Vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
  const Vec3 p = cross(ray.direction, e2);
  const double determinant = dot(e1, p);
  if (determinant == 0) return false;
  const Vec3 s = ray.origin - corners[0];
  const Vec3 q = cross(s, e1);
  hit.weights[1] = dot(s, p) / determinant;
  hit.weights[2] = dot(ray.direction, q) / determinant;
  hit.weights[0] = 1 - hit.weights[1] - hit.weights[2];
  hit.t = dot(e2, q) / determinant;
  return std::isfinite(hit.t);
}

/// Takes every hit Embree finds into the list, refined, and lets the ray go on.
void collect(const RTCFilterFunctionNArguments* args) {
  auto* query = static_cast<Query*>(args->context);
  args->valid[0] = 0;
  TriangleHit hit;
  hit.triangle = RTCHitN_primID(args->hit, args->N, 0);
  const auto& [a, b, c] = query->soup->triangles[hit.triangle];
  const auto& points = query->soup->points;
  if (!intersect_plane({points[a], points[b], points[c]}, *query->ray, hit)) return;
  if (!(hit.t > query->within.min && hit.t < query->within.max)) return;
  // Single precision may have let the ray in a hair outside the sides.
  double sum = 0;
  for (double& w : hit.weights) sum += w = std::clamp(w, 0.0, 1.0);
  for (double& w : hit.weights) w /= sum;
  query->hits->push_back(hit);
}

}  // namespace

bool intersect_triangle(const TriangleCorners& corners, const Ray& ray, TriangleHit& hit) {
  constexpr double kSlack = -1e-9;
  return intersect_plane(corners, ray, hit) && hit.weights[0] >= kSlack &&
         hit.weights[1] >= kSlack && hit.weights[2] >= kSlack;
}

struct TriangleTree::Impl {
  std::shared_ptr<RTCDeviceTy> device = embree_device();
  TriangleSoup soup;
  RTCScene scene = nullptr;

  ~Impl() { rtcReleaseScene(scene); }
};

TriangleTree::TriangleTree(TriangleSoup soup) : impl_(std::make_unique<Impl>()) {
  impl_->soup = std::move(soup);
  const auto& [vertices, triangles] = impl_->soup;
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

void TriangleTree::all_hits(const Ray& ray, Interval within, std::vector<TriangleHit>& hits) const {
  Query query;
  rtcInitIntersectContext(&query);
  query.ray = &ray;
  query.within = within;
  query.soup = &impl_->soup;
  query.hits = &hits;
  RTCRayHit rayhit = embree_ray(ray, within.max);
  rtcIntersect1(impl_->scene, &query, &rayhit);
}

}  // namespace isolux
