#include "isolux/raycast/ray_caster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "isolux/geometry/box_tree.h"
#include "isolux/geometry/instance.h"
#include "isolux/raycast/embree_device.h"
#include "isolux/raycast/shaft.h"

namespace isolux {
namespace {

/// An object as Embree sees it.
struct Primitive {
  const Object* object;
  std::uint32_t index;
  bool both_sides;
};

/// A shape whose tree several objects share, each through a map of its own.
struct SharedShape {
  const Shape* shape;
  double room = 0;  ///< m in the shape's frame, that rays may be off once they are mapped
  RTCScene rtc = nullptr;
};

/// Rays travel with their double-precision original; Embree's own single-precision ray only finds
/// the boxes to look into.
struct Query : RTCIntersectContext {
  Interval within;
  const Ray* ray = nullptr;
  // For nearest(): the best hit so far, whether it is on a side that takes part in the exchange of
  // light, and how close together, in t, hits coincide.
  std::optional<SurfaceHit> first;
  bool first_takes_part = false;
  double tie = 0;
  const Scene* scene = nullptr;
  // For all_hits(): where they go.
  std::vector<SurfaceHit>* all = nullptr;
  // For occluded(): the rays of the packet, by their id.
  std::span<const Segment> segments;
  // All objects, for what is met in a tree that several of them share.
  std::span<const Primitive> objects;
};

Ray ray_of(const Segment& s) { return {s.from, s.to - s.from}; }

constexpr double kSegmentEnd = 1 - 1e-6;
constexpr std::size_t kManyParts = 8;  // of a shape: worth a tree of its own

SurfaceHit surface_hit(const Primitive& primitive, const Hit& hit) {
  return {hit.t, hit.point, hit.normal, {primitive.index, hit.face}, false};
}

SurfaceHit other_side(SurfaceHit hit) {
  hit.normal = -hit.normal;
  hit.back = !hit.back;
  return hit;
}

bool earlier(const SurfaceHit& a, const SurfaceHit& b) {
  return std::tuple(a.t, a.surface.object, a.surface.face) <
         std::tuple(b.t, b.surface.object, b.surface.face);
}

/// Whether two hits lie in one and the same plane, the surface of one object glued to another's.
bool glued(const SurfaceHit& a, const SurfaceHit& b, double tie) {
  return a.surface.object != b.surface.object && std::abs(a.t - b.t) <= tie &&
         std::abs(dot(a.normal, b.normal)) > 0.9999;
}

/// Of two surfaces glued together that face alike, whether a's is the one that is there.
bool covers(const Scene& scene, const SurfaceHit& a, const SurfaceHit& b) {
  const auto rank = [&](const SurfaceHit& hit) {
    return std::pair(scene.objects[hit.surface.object].emits(), hit.surface.object);
  };
  return rank(a) > rank(b);
}

void set_bounds(const Bounds& b, double room, RTCBounds& out) {
  // Rays arrive rounded to single precision: the boxes have room for that.
  const double slack = room + 4e-7 * (length(b.lower) + length(b.upper)) + 1e-30;
  out.lower_x = static_cast<float>(b.lower.x - slack);
  out.lower_y = static_cast<float>(b.lower.y - slack);
  out.lower_z = static_cast<float>(b.lower.z - slack);
  out.upper_x = static_cast<float>(b.upper.x + slack);
  out.upper_y = static_cast<float>(b.upper.y + slack);
  out.upper_z = static_cast<float>(b.upper.z + slack);
}

void bounds_callback(const RTCBoundsFunctionArguments* args) {
  const auto& primitive = *static_cast<const Primitive*>(args->geometryUserPtr);
  set_bounds(primitive.object->shape->part_bounds(args->primID), 0, *args->bounds_o);
}

void shared_bounds_callback(const RTCBoundsFunctionArguments* args) {
  const auto& shared = *static_cast<const SharedShape*>(args->geometryUserPtr);
  set_bounds(shared.shape->part_bounds(args->primID), shared.room, *args->bounds_o);
}

/// The object that a callback is about: that of its geometry, or of the instance around it.
const Primitive& met_object(const Query& query, const void* geometry) {
  const unsigned instance = query.instID[0];
  return instance == RTC_INVALID_GEOMETRY_ID ? *static_cast<const Primitive*>(geometry)
                                             : query.objects[instance];
}

void intersect_callback(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& query = *static_cast<Query*>(args->context);
  const Primitive& primitive = met_object(query, args->geometryUserPtr);
  thread_local Hits hits;
  hits.clear();
  primitive.object->shape->intersect_part(args->primID, *query.ray, hits);
  for (const Hit& hit : hits) {
    if (!(hit.t > query.within.min && hit.t < query.within.max)) continue;
    const SurfaceHit found = surface_hit(primitive, hit);
    if (query.all) {
      query.all->push_back(found);
      if (primitive.both_sides) query.all->push_back(other_side(found));
      continue;
    }
    const bool takes_part = primitive.both_sides || dot(found.normal, query.ray->direction) < 0;
    bool first = !query.first;
    if (query.first && !glued(found, *query.first, query.tie)) {
      first = earlier(found, *query.first);
    } else if (query.first) {
      first = takes_part != query.first_takes_part ? takes_part
                                                   : covers(*query.scene, found, *query.first);
    }
    if (first) {
      query.first = found;
      query.first_takes_part = takes_part;
      float& tfar = RTCRayN_tfar(reinterpret_cast<RTCRayN*>(args->rayhit), args->N, 0);
      tfar = static_cast<float>((found.t + query.tie) * (1 + 1e-6));
    }
  }
}

void occluded_callback(const RTCOccludedFunctionNArguments* args) {
  auto& query = *static_cast<Query*>(args->context);
  const Primitive& primitive = met_object(query, args->geometryUserPtr);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (!args->valid[lane]) continue;
    const Segment& segment = query.segments[RTCRayN_id(args->ray, args->N, lane)];
    if (primitive.object->shape->part_occludes(args->primID, ray_of(segment), 0, kSegmentEnd)) {
      RTCRayN_tfar(args->ray, args->N, lane) = -std::numeric_limits<float>::infinity();
    }
  }
}

}  // namespace

class RayCaster::Impl {
 public:
  explicit Impl(const Scene& s) : scene(s) {
    rtc = rtcNewScene(device.get());
    rtcSetSceneFlags(rtc, RTC_SCENE_FLAG_ROBUST);
    primitives.reserve(scene.objects.size());
    for (const Object& object : scene.objects) add(object);
    find_shared();
    for (const Primitive& primitive : primitives) attach(primitive);
    rtcCommitScene(rtc);
    std::vector<Bounds> boxes;
    for (const std::uint32_t i : solids) boxes.push_back(bounds[i]);
    solid_tree.emplace(boxes);
  }
  ~Impl() {
    rtcReleaseScene(rtc);
    for (const auto& [shape, shared] : shared_shapes) rtcReleaseScene(shared.rtc);
  }

  void add(const Object& object) {
    const auto index = static_cast<std::uint32_t>(primitives.size());
    const bool solid = object.shape->solid();
    primitives.push_back({&object, index, object.sides == Sides::both && !solid});
    bounds.push_back(object.shape->bounds());
    if (solid) (object.shape->unbounded() ? endless : solids).push_back(index);
  }

  /// Finds what stands in several places and has many parts, and makes its trees.
  void find_shared() {
    std::unordered_map<const Shape*, std::size_t> uses;
    for (const Object& object : scene.objects) ++uses[original(object.shape).shape.get()];
    double reach = length(scene.bounds().lower) + length(scene.bounds().upper);
    for (const Camera& camera : scene.cameras) reach = std::max(reach, length(camera.eye));
    for (const Object& object : scene.objects) {
      const auto [shape, map] = original(object.shape);
      if (uses[shape.get()] == 1 || shape->part_count() < kManyParts) continue;
      if (const auto room = room_for(map.value_or(Affine{}), reach)) {
        SharedShape& shared =
            shared_shapes.try_emplace(shape.get(), SharedShape{shape.get()}).first->second;
        shared.room = std::max(shared.room, *room);
      }
    }
    for (auto& [shape, shared] : shared_shapes) {
      shared.rtc = rtcNewScene(device.get());
      rtcSetSceneFlags(shared.rtc, RTC_SCENE_FLAG_ROBUST);
      attach_parts(shared.rtc, 0, *shape, shared_bounds_callback, &shared);
      rtcCommitScene(shared.rtc);
    }
  }

  /// How far off, in the frame of a shape, Embree's rays may be once they are mapped there, from
  /// anywhere within `reach` of the origin; nothing where single precision is too coarse for that.
  static std::optional<double> room_for(const Affine& map, double reach) {
    constexpr double kMostDistorted = 1e4, kRounding = 4e-7;
    const auto norm = [](const Affine& m) {
      return std::sqrt(length_squared(m.linear[0]) + length_squared(m.linear[1]) +
                       length_squared(m.linear[2]));
    };
    const double back = norm(*map.inverse()), distorted = norm(map) * back;
    if (!(distorted < kMostDistorted)) return std::nullopt;
    return kRounding * distorted * back * (reach + length(map.translation));
  }

  void attach(const Primitive& primitive) {
    const auto [shape, map] = original(primitive.object->shape);
    const auto shared = shared_shapes.find(shape.get());
    const Affine placed = map.value_or(Affine{});
    if (shared == shared_shapes.end() || !room_for(placed, 0)) {
      return attach_parts(rtc, primitive.index, *primitive.object->shape, bounds_callback,
                          const_cast<Primitive*>(&primitive));
    }
    std::array<float, 12> columns;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        columns[static_cast<std::size_t>(3 * k + i)] =
            static_cast<float>(placed.linear[static_cast<std::size_t>(i)][k]);
      }
      columns[static_cast<std::size_t>(9 + i)] = static_cast<float>(placed.translation[i]);
    }
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, shared->second.rtc);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    attach(rtc, primitive.index, geometry);
  }

  void attach_parts(RTCScene to, unsigned id, const Shape& shape, RTCBoundsFunction box,
                    void* data) {
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(shape.part_count()));
    rtcSetGeometryUserData(geometry, data);
    rtcSetGeometryBoundsFunction(geometry, box, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect_callback);
    rtcSetGeometryOccludedFunction(geometry, occluded_callback);
    attach(to, id, geometry);
  }

  static void attach(RTCScene to, unsigned id, RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(to, geometry, id);
    rtcReleaseGeometry(geometry);
  }

  /// Sends the query's ray through the tree.
  void trace(Query& query) const {
    rtcInitIntersectContext(&query);
    query.objects = primitives;
    RTCRayHit rayhit = embree_ray(*query.ray, query.within.max);
    rtcIntersect1(rtc, &query, &rayhit);
  }

  const Scene& scene;
  std::shared_ptr<RTCDeviceTy> device = embree_device();
  RTCScene rtc = nullptr;
  std::vector<Primitive> primitives;  // by object; Embree holds pointers to them
  std::vector<Bounds> bounds;         // by object
  // By original; Embree holds pointers to these too.
  std::unordered_map<const Shape*, SharedShape> shared_shapes;
  // Objects that are solid, and those that are so beyond their bounds too, as a room's walls are.
  std::vector<std::uint32_t> solids, endless;
  std::optional<BoxTree> solid_tree;  // of `solids`
};

RayCaster::RayCaster(const Scene& scene)
    : impl_(std::make_unique<Impl>(scene)), epsilon_(1e-7 * scene.bounds().diagonal()) {}
RayCaster::~RayCaster() = default;

const Scene& RayCaster::scene() const { return impl_->scene; }

std::optional<SurfaceHit> RayCaster::nearest(const Ray& ray, Interval within) const {
  Query query;
  query.ray = &ray;
  query.within = within;
  query.tie = epsilon() / length(ray.direction);
  query.scene = &impl_->scene;
  impl_->trace(query);
  if (!query.first) return std::nullopt;
  const SurfaceHit& hit = *query.first;
  const Primitive& primitive = impl_->primitives[hit.surface.object];
  if (primitive.both_sides && dot(hit.normal, ray.direction) > 0) return other_side(hit);
  return hit;
}

void RayCaster::all_hits(const Ray& ray, Interval within, std::vector<SurfaceHit>& hits) const {
  hits.clear();
  Query query;
  query.ray = &ray;
  query.within = within;
  query.all = &hits;
  impl_->trace(query);

  const auto facing = [&](const SurfaceHit& hit) { return dot(hit.normal, ray.direction) < 0; };
  std::sort(hits.begin(), hits.end(), [&](const SurfaceHit& a, const SurfaceHit& b) {
    return std::tuple(a.t, a.surface.object, a.surface.face, !facing(a)) <
           std::tuple(b.t, b.surface.object, b.surface.face, !facing(b));
  });

  // Glued surfaces are neighbours in the list, or nearly so.
  const double tie = epsilon() / length(ray.direction);
  thread_local std::vector<char> hidden;
  hidden.assign(hits.size(), 0);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    for (std::size_t j = i + 1; j < hits.size() && hits[j].t - hits[i].t <= tie; ++j) {
      if (!glued(hits[i], hits[j], tie) || dot(hits[i].normal, hits[j].normal) < 0) continue;
      hidden[covers(impl_->scene, hits[i], hits[j]) ? j : i] = 1;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hidden[i]) hits[kept++] = hits[i];
  }
  hits.resize(kept);
}

bool RayCaster::occluded(const Segment& segment) const {
  std::uint8_t blocked = 0;
  occluded({&segment, 1}, {&blocked, 1});
  return blocked != 0;
}

void RayCaster::occluded(std::span<const Segment> segments, std::span<std::uint8_t> blocked) const {
  constexpr std::size_t kLanes = 16;
  Query query;
  rtcInitIntersectContext(&query);
  query.objects = impl_->primitives;
  query.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t first = 0; first < segments.size(); first += kLanes) {
    const std::size_t n = std::min(kLanes, segments.size() - first);
    query.segments = segments.subspan(first, n);
    RTCRay16 rays;
    alignas(64) std::array<int, kLanes> valid;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      valid[lane] = lane < n ? -1 : 0;
      const Segment& segment = query.segments[std::min(lane, n - 1)];
      const Vec3 d = segment.to - segment.from;
      rays.org_x[lane] = static_cast<float>(segment.from.x);
      rays.org_y[lane] = static_cast<float>(segment.from.y);
      rays.org_z[lane] = static_cast<float>(segment.from.z);
      rays.dir_x[lane] = static_cast<float>(d.x);
      rays.dir_y[lane] = static_cast<float>(d.y);
      rays.dir_z[lane] = static_cast<float>(d.z);
      rays.tnear[lane] = 0;
      rays.tfar[lane] = 1;
      rays.time[lane] = 0;
      rays.mask[lane] = ~0u;
      rays.id[lane] = static_cast<unsigned>(lane);
      rays.flags[lane] = 0;
    }
    rtcOccluded16(valid.data(), impl_->rtc, &query, &rays);
    for (std::size_t lane = 0; lane < n; ++lane) blocked[first + lane] = rays.tfar[lane] < 0;
  }
}

Blockers RayCaster::blockers(const Bounds& from, const Bounds& to) const {
  constexpr std::size_t kMostObjects = 256, kMostParts = 4;
  Blockers found;
  found.many_ = impl_->primitives.size() > kMostObjects;
  if (found.many_) return found;
  // Room for the hair by which points are lifted off surfaces. It lifts them off the walls of a
  // room into the room, so that these need none.
  const Vec3 hair = Vec3{1, 1, 1} * (2 * epsilon());
  const auto grown = [&](const Bounds& b) { return Bounds{b.lower - hair, b.upper + hair}; };
  const Shaft shaft(grown(from), grown(to));
  Bounds both = from;
  both.include(to);
  for (std::uint32_t i = 0; i < impl_->bounds.size(); ++i) {
    const Shape& shape = *impl_->scene.objects[i].shape;
    if (shaft.misses(impl_->bounds[i]) || shape.avoids(both)) continue;
    found.many_ = found.count_ == Blockers::kMost || shape.part_count() > kMostParts;
    if (found.many_) return found;
    found.objects_[found.count_++] = i;
  }
  return found;
}

void RayCaster::occluded(const Blockers& among, std::span<const Segment> segments,
                         std::span<std::uint8_t> blocked) const {
  if (among.many_) return occluded(segments, blocked);
  constexpr std::size_t kLanes = SegmentBlock::kLanes;
  for (std::size_t first = 0; first < segments.size(); first += kLanes) {
    const std::size_t n = std::min(kLanes, segments.size() - first);
    SegmentBlock block;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      block.set(lane, ray_of(segments[first + std::min(lane, n - 1)]));
    }
    SegmentBlock::Mask mask{};
    for (std::size_t k = 0; k < among.count_; ++k) {
      impl_->scene.objects[among.objects_[k]].shape->occlude(block, kSegmentEnd, mask);
    }
    for (std::size_t lane = 0; lane < n; ++lane) {
      blocked[first + lane] = static_cast<std::uint8_t>(mask[lane]);
    }
  }
}

bool RayCaster::buried(const Vec3& point, const Vec3& normal) const {
  const Vec3 p = point + normal * epsilon();
  const auto inside = [&](std::uint32_t i) { return impl_->scene.objects[i].shape->contains(p); };
  return std::any_of(impl_->endless.begin(), impl_->endless.end(), inside) ||
         impl_->solid_tree->any(
             [&](const Bounds& box) {
               return box.encloses({p, p});
             },
             [&](std::uint32_t k) {
               const std::uint32_t i = impl_->solids[k];
               return impl_->bounds[i].encloses({p, p}) && inside(i);
             });
}

}  // namespace isolux
