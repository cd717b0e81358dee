#include "isolux/raycast/ray_caster.h"

#include <algorithm>
#include <array>

#include "isolux/geometry/box_tree.h"
#include "isolux/raycast/object_tree.h"
#include "isolux/raycast/shaft.h"

namespace isolux {
namespace {

/// What is known of a ray on its way. It is the double-precision original: Embree's own
/// single-precision ray only finds the boxes to look into.
struct Search {
  const Ray* ray = nullptr;
  // For nearest(): the best hit so far, whether it is on a side that takes part in the exchange of
  // light, and how close together, in t, hits coincide.
  std::optional<SurfaceHit> first;
  bool first_takes_part = false;
  double tie = 0;
};

struct Query : RTCIntersectContext {
  Interval within;
  std::span<Search> searches;  // of the packet, by their id
  const Scene* scene = nullptr;
  // For all_hits(): where they go.
  std::vector<SurfaceHit>* all = nullptr;
  // For occluded(): the rays of the packet, by their id; in a block where they are many.
  std::span<const Segment> segments;
  const SegmentBlock* block = nullptr;
  const ObjectTree* tree = nullptr;
};

Ray ray_of(const Segment& s) { return {s.from, s.to - s.from}; }

constexpr double kSegmentEnd = 1 - 1e-6;

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

/// Takes the hit if it is the first so far; whether it is.
bool take_first(const Query& query, const SurfaceHit& found, bool both_sides, Search& search) {
  const bool takes_part = both_sides || dot(found.normal, search.ray->direction) < 0;
  bool first = !search.first;
  if (search.first && !glued(found, *search.first, search.tie)) {
    first = earlier(found, *search.first);
  } else if (search.first) {
    first = takes_part != search.first_takes_part ? takes_part
                                                  : covers(*query.scene, found, *search.first);
  }
  if (first) {
    search.first = found;
    search.first_takes_part = takes_part;
  }
  return first;
}

/// Holds one ray of a packet against a part of a shape.
void intersect_part(const Query& query, const Primitive& primitive, unsigned part, Search& search,
                    float& tfar) {
  thread_local Hits hits;
  hits.clear();
  primitive.object->shape->intersect_part(part, *search.ray, hits);
  for (const Hit& hit : hits) {
    if (!(hit.t > query.within.min && hit.t < query.within.max)) continue;
    const SurfaceHit found = surface_hit(primitive, hit);
    if (query.all) {
      query.all->push_back(found);
      if (primitive.both_sides) query.all->push_back(other_side(found));
    } else if (take_first(query, found, primitive.both_sides, search)) {
      tfar = static_cast<float>((found.t + search.tie) * (1 + 1e-6));
    }
  }
}

void intersect_callback(const RTCIntersectFunctionNArguments* args) {
  const auto& query = *static_cast<Query*>(args->context);
  const Primitive& primitive = query.tree->primitive(query, args->geometryUserPtr);
  RTCRayN* const packet = RTCRayHitN_RayN(args->rayhit, args->N);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (!args->valid[lane]) continue;
    intersect_part(query, primitive, args->primID,
                   query.searches[RTCRayN_id(packet, args->N, lane)],
                   RTCRayN_tfar(packet, args->N, lane));
  }
}

void occluded_callback(const RTCOccludedFunctionNArguments* args) {
  constexpr std::ptrdiff_t kFew = 3;  // rays, quicker one by one
  auto& query = *static_cast<Query*>(args->context);
  const Primitive& primitive = query.tree->primitive(query, args->geometryUserPtr);
  const Shape& shape = *primitive.object->shape;
  const bool together = query.block && shape.part_count() == 1 &&
                        std::count(args->valid, args->valid + args->N, -1) > kFew;
  SegmentBlock::Mask blocked;
  if (together) {
    blocked.fill(1);  // those are not asked for
    for (unsigned lane = 0; lane < args->N; ++lane) {
      if (args->valid[lane]) blocked[RTCRayN_id(args->ray, args->N, lane)] = 0;
    }
    shape.occlude(*query.block, kSegmentEnd, blocked);
  }
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (!args->valid[lane]) continue;
    const unsigned id = RTCRayN_id(args->ray, args->N, lane);
    if (together ? blocked[id] != 0
                 : shape.part_occludes(args->primID, ray_of(query.segments[id]), 0, kSegmentEnd)) {
      RTCRayN_tfar(args->ray, args->N, lane) = -std::numeric_limits<float>::infinity();
    }
  }
}

/// A ray of a packet, whose id is its lane.
void set_lane(RTCRay16& rays, std::size_t lane, const Ray& ray, float t_max) {
  rays.org_x[lane] = static_cast<float>(ray.origin.x);
  rays.org_y[lane] = static_cast<float>(ray.origin.y);
  rays.org_z[lane] = static_cast<float>(ray.origin.z);
  rays.dir_x[lane] = static_cast<float>(ray.direction.x);
  rays.dir_y[lane] = static_cast<float>(ray.direction.y);
  rays.dir_z[lane] = static_cast<float>(ray.direction.z);
  rays.tnear[lane] = 0;
  rays.tfar[lane] = t_max;
  rays.time[lane] = 0;
  rays.mask[lane] = ~0u;
  rays.id[lane] = static_cast<unsigned>(lane);
  rays.flags[lane] = 0;
}

}  // namespace

class RayCaster::Impl {
 public:
  explicit Impl(const Scene& s) : scene(s), tree(s, intersect_callback, occluded_callback) {
    std::vector<Bounds> boxes;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
      const Shape& shape = *scene.objects[i].shape;
      bounds.push_back(shape.bounds());
      if (!shape.solid()) continue;
      (shape.unbounded() ? endless : solids).push_back(i);
      if (!shape.unbounded()) boxes.push_back(bounds.back());
    }
    solid_tree.emplace(boxes);
    bounds_tree.emplace(bounds);
  }

  /// Sends the query's only ray through the tree.
  void trace(Query& query) const {
    start(query);
    RTCRayHit rayhit = embree_ray(*query.searches[0].ray, query.within.max);
    rtcIntersect1(tree.rtc(), &query, &rayhit);
  }

  void start(Query& query) const {
    rtcInitIntersectContext(&query);
    query.tree = &tree;
    query.scene = &scene;
  }

  /// What the ray met first, as seen from its origin.
  std::optional<SurfaceHit> seen_by(const Search& search) const {
    const std::optional<SurfaceHit>& hit = search.first;
    if (!hit || !tree.primitives()[hit->surface.object].both_sides) return hit;
    return dot(hit->normal, search.ray->direction) > 0 ? other_side(*hit) : *hit;
  }

  const Scene& scene;
  ObjectTree tree;
  std::vector<Bounds> bounds;  // by object
  // Objects that are solid, and those that are so beyond their bounds too, as a room's walls are.
  std::vector<std::uint32_t> solids, endless;
  std::optional<BoxTree> solid_tree;   // of `solids`
  std::optional<BoxTree> bounds_tree;  // of `bounds`
};

RayCaster::RayCaster(const Scene& scene)
    : impl_(std::make_unique<Impl>(scene)), epsilon_(1e-7 * scene.bounds().diagonal()) {}
RayCaster::~RayCaster() = default;

const Scene& RayCaster::scene() const { return impl_->scene; }

std::optional<SurfaceHit> RayCaster::nearest(const Ray& ray, Interval within) const {
  Search search{&ray, {}, false, epsilon() / length(ray.direction)};
  Query query;
  query.within = within;
  query.searches = {&search, 1};
  impl_->trace(query);
  return impl_->seen_by(search);
}

void RayCaster::nearest(std::span<const Ray> rays,
                        std::span<std::optional<SurfaceHit>> hits) const {
  constexpr std::size_t kLanes = 16;
  Query query;
  impl_->start(query);
  for (std::size_t begin = 0; begin < rays.size(); begin += kLanes) {
    const std::size_t n = std::min(kLanes, rays.size() - begin);
    std::array<Search, kLanes> searches;
    query.searches = searches;
    RTCRayHit16 packet;
    alignas(64) std::array<int, kLanes> valid;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      valid[lane] = lane < n ? -1 : 0;
      const Ray& ray = rays[begin + std::min(lane, n - 1)];
      searches[lane].ray = &ray;
      searches[lane].tie = epsilon() / length(ray.direction);
      set_lane(packet.ray, lane, ray, std::numeric_limits<float>::infinity());
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid.data(), impl_->tree.rtc(), &query, &packet);
    for (std::size_t lane = 0; lane < n; ++lane) {
      hits[begin + lane] = impl_->seen_by(searches[lane]);
    }
  }
}

void RayCaster::all_hits(const Ray& ray, Interval within, std::vector<SurfaceHit>& hits) const {
  hits.clear();
  Search search{&ray, {}, false, 0};
  Query query;
  query.within = within;
  query.searches = {&search, 1};
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
  Query query;
  impl_->start(query);
  query.segments = {&segment, 1};
  RTCRay ray = embree_ray(ray_of(segment), 1).ray;
  rtcOccluded1(impl_->tree.rtc(), &query, &ray);
  return ray.tfar < 0;
}

void RayCaster::occluded(std::span<const Segment> segments, std::span<std::uint8_t> blocked) const {
  constexpr std::size_t kLanes = SegmentBlock::kLanes;
  static_assert(kLanes == 16);
  SegmentBlock block;
  Query query;
  rtcInitIntersectContext(&query);
  query.tree = &impl_->tree;
  query.block = &block;
  // Embree 3.13 may not come back with coherent packets from trees within trees.
  if (!impl_->tree.has_shared()) query.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t first = 0; first < segments.size(); first += kLanes) {
    const std::size_t n = std::min(kLanes, segments.size() - first);
    query.segments = segments.subspan(first, n);
    RTCRay16 rays;
    alignas(64) std::array<int, kLanes> valid;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      valid[lane] = lane < n ? -1 : 0;
      const Segment& segment = query.segments[std::min(lane, n - 1)];
      set_lane(rays, lane, ray_of(segment), 1);
      block.set(lane, ray_of(segment));
    }
    rtcOccluded16(valid.data(), impl_->tree.rtc(), &query, &rays);
    for (std::size_t lane = 0; lane < n; ++lane) blocked[first + lane] = rays.tfar[lane] < 0;
  }
}

Blockers RayCaster::blockers(const Bounds& from, const Bounds& to,
                             std::optional<std::uint32_t> except) const {
  constexpr std::size_t kMostParts = 4;
  Blockers found;
  // Room for the hair by which points are lifted off surfaces. It lifts them off the walls of a
  // room into the room, so that these need none.
  const Vec3 hair = Vec3{1, 1, 1} * (2 * epsilon());
  const auto grown = [&](const Bounds& b) { return Bounds{b.lower - hair, b.upper + hair}; };
  const Shaft shaft(grown(from), grown(to));
  Bounds both = from;
  both.include(to);
  found.many_ = impl_->bounds_tree->any(
      [&](const Bounds& box) { return !shaft.misses(box); },
      [&](std::uint32_t i) {
        if (i == except) return false;
        const Shape& shape = *impl_->scene.objects[i].shape;
        if (shaft.misses(impl_->bounds[i]) || shape.avoids(both)) return false;
        if (found.count_ == Blockers::kMost || shape.part_count() > kMostParts) return true;
        found.objects_[found.count_++] = i;
        return false;
      });
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
    const auto all_blocked = [&] {
      return std::all_of(mask.begin(), mask.end(), [](std::int64_t lane) { return lane != 0; });
    };
    for (std::size_t k = 0; k < among.count_ && !all_blocked(); ++k) {
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
