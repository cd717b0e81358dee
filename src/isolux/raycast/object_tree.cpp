#include "isolux/raycast/object_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "isolux/geometry/instance.h"

namespace isolux {
namespace {

constexpr std::size_t kManyParts = 8;  // of a shape: worth a tree of its own
constexpr double kRounding = 4e-7;     // of single precision, some steps of it

void set_bounds(const Bounds& b, double room, RTCBounds& out) {
  const double slack = room + kRounding * (length(b.lower) + length(b.upper)) + 1e-30;
  out.lower_x = static_cast<float>(b.lower.x - slack);
  out.lower_y = static_cast<float>(b.lower.y - slack);
  out.lower_z = static_cast<float>(b.lower.z - slack);
  out.upper_x = static_cast<float>(b.upper.x + slack);
  out.upper_y = static_cast<float>(b.upper.y + slack);
  out.upper_z = static_cast<float>(b.upper.z + slack);
}

double norm(const Affine& map) {
  const auto& [x, y, z] = map.linear;
  return std::sqrt(length_squared(x) + length_squared(y) + length_squared(z));
}

/// How far off, in the frame of a shape under that map, a ray of Embree's may be that comes from
/// within `reach` of the origin; nothing where single precision is too coarse for the map.
std::optional<double> room_for(const Affine& map, double reach) {
  constexpr double kMostDistorted = 1e4;
  const std::optional<Affine> inverse = map.inverse();
  if (!inverse) return std::nullopt;
  const double back = norm(*inverse), distorted = norm(map) * back;
  if (!(distorted < kMostDistorted)) return std::nullopt;
  return kRounding * distorted * back * (reach + length(map.translation));
}

/// How far from the origin rays come from.
double reach_of(const Scene& scene) {
  const Bounds box = scene.bounds();
  double reach = length(box.lower) + length(box.upper);
  for (const Camera& camera : scene.cameras) reach = std::max(reach, length(camera.eye));
  return reach;
}

void attach_geometry(RTCScene to, unsigned id, RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(to, geometry, id);
  rtcReleaseGeometry(geometry);
}

}  // namespace

ObjectTree::ObjectTree(const Scene& scene, RTCIntersectFunctionN intersect,
                       RTCOccludedFunctionN occluded)
    : intersect_(intersect), occluded_(occluded), rtc_(rtcNewScene(device_.get())) {
  rtcSetSceneFlags(rtc_, RTC_SCENE_FLAG_ROBUST);
  primitives_.reserve(scene.objects.size());
  for (const Object& object : scene.objects) {
    const auto index = static_cast<std::uint32_t>(primitives_.size());
    primitives_.push_back({&object, index, object.sides == Sides::both && !object.shape->solid()});
  }
  make_shared_trees(scene);
  for (const Primitive& primitive : primitives_) attach(primitive);
  rtcCommitScene(rtc_);
}

ObjectTree::~ObjectTree() {
  rtcReleaseScene(rtc_);
  for (const auto& [shape, shared] : shared_) rtcReleaseScene(shared.rtc);
}

const Primitive& ObjectTree::primitive(const RTCIntersectContext& context,
                                       const void* geometry_data) const {
  const unsigned instance = context.instID[0];  // the number of an object
  return instance == RTC_INVALID_GEOMETRY_ID ? *static_cast<const Primitive*>(geometry_data)
                                             : primitives_[instance];
}

void ObjectTree::make_shared_trees(const Scene& scene) {
  std::unordered_map<const Shape*, std::size_t> uses;
  for (const Object& object : scene.objects) ++uses[original(object.shape).shape.get()];
  const double reach = reach_of(scene);
  for (const Object& object : scene.objects) {
    const auto [shape, map] = original(object.shape);
    if (uses[shape.get()] == 1 || shape->part_count() < kManyParts) continue;
    if (const auto room = room_for(map.value_or(Affine{}), reach)) {
      Shared& shared = shared_.try_emplace(shape.get(), Shared{shape.get()}).first->second;
      shared.room = std::max(shared.room, *room);
    }
  }
  for (auto& [shape, shared] : shared_) {
    shared.rtc = rtcNewScene(device_.get());
    rtcSetSceneFlags(shared.rtc, RTC_SCENE_FLAG_ROBUST);
    attach_parts(shared.rtc, 0, *shape, shared_bounds, &shared);
    rtcCommitScene(shared.rtc);
  }
}

void ObjectTree::attach(const Primitive& primitive) {
  const auto [shape, map] = original(primitive.object->shape);
  const Affine placed = map.value_or(Affine{});
  const auto shared = shared_.find(shape.get());
  if (shared != shared_.end() && room_for(placed, 0)) {
    return attach_instance(primitive.index, shared->second, placed);
  }
  attach_parts(rtc_, primitive.index, *primitive.object->shape, primitive_bounds, &primitive);
}

void ObjectTree::attach_instance(unsigned id, const Shared& shared, const Affine& map) {
  std::array<float, 12> columns;
  for (std::size_t row = 0; row < 3; ++row) {
    const Vec3& r = map.linear[row];
    const std::array<double, 4> entries{r.x, r.y, r.z, map.translation[static_cast<int>(row)]};
    for (std::size_t k = 0; k < 4; ++k) columns[3 * k + row] = static_cast<float>(entries[k]);
  }
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, shared.rtc);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
  attach_geometry(rtc_, id, geometry);
}

void ObjectTree::attach_parts(RTCScene to, unsigned id, const Shape& shape,
                              RTCBoundsFunction bounds, const void* data) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(shape.part_count()));
  rtcSetGeometryUserData(geometry, const_cast<void*>(data));  // that Embree only hands back
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_);
  rtcSetGeometryOccludedFunction(geometry, occluded_);
  attach_geometry(to, id, geometry);
}

void ObjectTree::primitive_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& primitive = *static_cast<const Primitive*>(args->geometryUserPtr);
  set_bounds(primitive.object->shape->part_bounds(args->primID), 0, *args->bounds_o);
}

void ObjectTree::shared_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& shared = *static_cast<const Shared*>(args->geometryUserPtr);
  set_bounds(shared.shape->part_bounds(args->primID), shared.room, *args->bounds_o);
}

}  // namespace isolux
