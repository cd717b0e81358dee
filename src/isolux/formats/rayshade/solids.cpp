#include "isolux/formats/rayshade/solids.h"

#include <fmt/format.h>

#include <algorithm>

#include "isolux/formats/rayshade/make.h"
#include "isolux/geometry/frustum.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/tessellation.h"
#include "isolux/geometry/triangle_mesh.h"
#include "isolux/scene/spelling.h"

namespace isolux::rayshade {
namespace {

constexpr double kSamePlace = 1e-3;  ///< of a tube's radius, between its end and a disc there
constexpr std::size_t kMostRuns = 2'000'000;  ///< of faces, in all solids
constexpr std::ptrdiff_t kCapsWithin = 100;   ///< places in a list, from a tube to its discs

template <typename T>
const T* as(const Node& node) {
  return std::get_if<T>(&node.geometry);
}

/// Whether the disc closes an end of the tube.
bool caps(const Disc& disc, const Tube& tube) {
  const double slack = kSamePlace * std::max(tube.from_radius, tube.to_radius);
  const bool along = length(cross(disc.normal, normalized(tube.to - tube.from))) < kSamePlace;
  const auto at = [&](const Vec3& end, double radius) {
    return distance(disc.center, end) < slack && std::abs(disc.radius - radius) < slack;
  };
  return along && (at(tube.from, tube.from_radius) || at(tube.to, tube.to_radius));
}

/// Whether a disc is a cap of a tube near it in the list.
bool is_cap(const std::vector<NodePtr>& list, std::size_t disc) {
  if (list[disc]->map) return false;
  const auto at = list.begin() + static_cast<std::ptrdiff_t>(disc);
  return std::any_of(at - std::min<std::ptrdiff_t>(kCapsWithin, at - list.begin()),
                     at + std::min<std::ptrdiff_t>(kCapsWithin, list.end() - at),
                     [&](const NodePtr& other) {
                       const Tube* tube = as<Tube>(*other);
                       return tube && !other->map && caps(*as<Disc>(**at), *tube);
                     });
}

[[noreturn]] void refuse_open(const Node& node) {
  fail(node.place,
       fmt::format("{} is open, and CSG takes closed shapes only{}", in_quotes(node.word),
                   as<Disc>(node) ? ": a disc must close an end of a cylinder or cone "
                                    "of its list"
                                  : ""));
}

void append(TriangleSoup& soup, const Node& node) {
  TriangleSoup more = as<Facets>(node)->soup;
  if (node.map) {
    for (Vec3& p : more.points) p = node.map->point(p);
    if (node.map->determinant() < 0) flip(more);
  }
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  soup.points.insert(soup.points.end(), more.points.begin(), more.points.end());
  for (const auto& [a, b, c] : more.triangles) {
    soup.triangles.push_back({first + a, first + b, first + c});
  }
}

ShapePtr closed_mesh(const TriangleSoup& soup, const Node& node) {
  const auto mesh = make<TriangleMesh>(node.place, node.word, soup.points, soup.triangles);
  if (!mesh->solid()) {
    fail(node.place,
         fmt::format("the triangles and polygons of this {} leave holes, or are not all "
                     "wound alike, and CSG takes closed shapes only",
                     in_quotes(node.word)));
  }
  return mesh;
}

Solid joined(CsgOperation operation, const std::vector<Solid>& solids) {
  std::vector<ShapePtr> shapes;
  std::vector<FaceRun> faces;
  for (const Solid& solid : solids) {
    shapes.push_back(solid.shape);
    for (const FaceRun& run : solid.faces) {
      if (!faces.empty() && faces.back().finish == run.finish) {
        faces.back().count += run.count;
      } else {
        faces.push_back(run);
      }
    }
  }
  return {join(operation, shapes), std::move(faces)};
}

}  // namespace

Solid Solids::solid(const Node& node, const Affine& map) {
  if (node.has_planes) return make_solid(node, map);  // which are cut in the world
  const auto found = made_.find(&node);
  if (found != made_.end()) return found->second;
  return made_[&node] = make_solid(node, map);
}

/// The solid with its own map.
Solid Solids::placed(const Node& node, const Affine& map) {
  if (!node.map) return solid(node, map);
  Solid placed = solid(node, map * *node.map);
  placed.shape = make<Instance>(node.place, node.word, std::move(placed.shape), *node.map);
  return placed;
}

Solid Solids::make_solid(const Node& node, const Affine& map) {
  Solid made;
  const auto* const group = as<Group>(node);
  if (const auto* reference = as<Reference>(node)) {
    made = placed(*reference->target, map);
  } else if (group && !group->operation) {
    made = join_list(node, map);
  } else if (group) {
    std::vector<Solid> solids;
    for (const NodePtr& member : group->members) solids.push_back(placed(*member, map));
    try {
      made = joined(*group->operation, solids);
    } catch (const InputError& error) {
      fail(node.place, fmt::format("{} can't be made: {}", in_quotes(node.word), error.what()));
    }
  } else {
    made.shape = make_simple(node, map);
    made.faces = {{made.shape->face_count(), {}}};
  }
  if (node.surface) {
    for (FaceRun& run : made.faces) {
      if (!run.finish) run.finish = Finish{material_of_(*node.surface), {}};
    }
  }
  runs_ += made.faces.size();
  if (runs_ > kMostRuns) fail(node.place, "the solids of this scene have too many surfaces");
  return made;
}

ShapePtr Solids::make_simple(const Node& node, const Affine& map) {
  if (const auto* shape = as<ShapePtr>(node)) {
    if (!(*shape)->solid()) refuse_open(node);
    return *shape;
  }
  if (const auto* tube = as<Tube>(node)) {
    return make<Frustum>(node.place, node.word, tube->from, tube->to, tube->from_radius,
                         tube->to_radius, true);
  }
  if (const auto* plane = as<Plane>(node)) {
    notes_.add("planes in CSG are cubes of the size that planes are cut to");
    return cut_.half_space(*plane, map);
  }
  if (const auto* facets = as<Facets>(node)) return closed_mesh(facets->soup, node);
  refuse_open(node);
}

Solid Solids::join_list(const Node& list, const Affine& map) {
  const std::vector<NodePtr>& members = as<Group>(list)->members;
  std::vector<Solid> solids;
  TriangleSoup soup;
  SurfacePtr surface;  // that of the first facet counts for all
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Node& member = *members[i];
    if (as<Facets>(member)) {
      if (soup.triangles.empty()) surface = member.surface;
      append(soup, member);
    } else if (!as<Disc>(member)) {
      solids.push_back(placed(member, map));
    } else if (!is_cap(members, i)) {
      refuse_open(member);
    }
  }
  if (!soup.triangles.empty()) {
    const ShapePtr mesh = closed_mesh(soup, list);
    FaceRun faces{mesh->face_count(), {}};
    if (surface) faces.finish = Finish{material_of_(*surface), {}};
    solids.push_back({mesh, {faces}});
  }
  if (solids.empty()) fail(list.place, fmt::format("this {} is empty", in_quotes(list.word)));
  return joined(CsgOperation::unite, solids);
}

}  // namespace isolux::rayshade
