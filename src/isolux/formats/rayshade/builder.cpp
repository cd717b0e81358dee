#include "isolux/formats/rayshade/builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <tuple>

#include "isolux/formats/limits.h"
#include "isolux/formats/object_names.h"
#include "isolux/formats/rayshade/leaves.h"
#include "isolux/formats/rayshade/lights.h"
#include "isolux/formats/rayshade/make.h"
#include "isolux/formats/rayshade/solids.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux::rayshade {
namespace {

constexpr double kSmallestScene = 1e-6, kLargestScene = 1e10;  ///< m
constexpr double kPlaneSide = 4;                               ///< of the scene's size

class Builder {
 public:
  Builder(const Model& model, Notes& notes)
      : model_(model), notes_(notes), leaves_(leaves_of(model.objects)) {
    measure();
  }
  Scene build();

 private:
  void measure();
  Solid shape_of(const Leaf& leaf);
  Solid local_shape(const Leaf& leaf);
  ShapePtr seen_from_eye(ShapePtr shape);
  std::uint32_t material_of(const Surface& surface);
  std::string name_of(const Leaf& leaf);
  void add(const Object& object, const Solid& solid, const Node& node);
  Camera camera() const;

  const Model& model_;
  Notes& notes_;
  std::vector<Leaf> leaves_;
  Extent extent_;
  PlaneCut cut_;
  Solids solids_{cut_, notes_, [this](const Surface& surface) { return material_of(surface); }};
  Scene scene_;
  std::map<const Node*, ShapePtr> meshes_;
  std::map<std::tuple<std::string, double, double, double>, std::uint32_t> materials_;
  NumberedNames material_names_, object_names_;
  std::size_t split_runs_ = 0;  ///< of faces, in all solids with several surfaces
};

/// Finds the scene's middle and size. Planes count with their point nearest to the middle.
void Builder::measure() {
  Bounds finite;
  FiniteBounds bounds;
  for (const Leaf& leaf : leaves_) finite.include(bounds.of(leaf));
  if (finite.empty()) finite.include(model_.view.look_at);
  extent_.middle = finite.center();
  finite.include(model_.view.eye);
  for (const Light& light : model_.lights) {
    if (light.kind != Light::Kind::directional) finite.include(light.position);
  }
  for (const Leaf& leaf : leaves_) {
    const auto* plane = std::get_if<Plane>(&leaf.node->geometry);
    if (plane) finite.include(foot_on(mapped(*plane, leaf.map), extent_.middle));
  }
  extent_.size = finite.diagonal();
  if (!(extent_.size >= kSmallestScene && extent_.size <= kLargestScene)) {
    fail(leaves_.front().node->place,
         fmt::format("the scene is {:.3g} m large, and must be between {:g} and {:g} m",
                     extent_.size, kSmallestScene, kLargestScene));
  }
  cut_ = {extent_.middle, kPlaneSide * extent_.size};
}

/// The leaf's shape in its own frame, shared by all mentions of it; the faces of what CSG joins.
Solid Builder::local_shape(const Leaf& leaf) {
  const Node& node = *leaf.node;
  if (const auto* shape = std::get_if<ShapePtr>(&node.geometry)) return {*shape, {}};
  if (const auto* tube = std::get_if<Tube>(&node.geometry)) return {tube->side, {}};
  if (const auto* disc = std::get_if<Disc>(&node.geometry)) return {disc->shape, {}};
  if (const auto* facets = std::get_if<Facets>(&node.geometry)) {
    if (facets->polygon) return {facets->polygon, {}};
    ShapePtr& mesh = meshes_[&node];
    if (!mesh) {
      mesh = make<TriangleMesh>(node.place, node.word, facets->soup.points, facets->soup.triangles);
    }
    return {mesh, {}};
  }
  return solids_.solid(node, leaf.map);
}

Solid Builder::shape_of(const Leaf& leaf) {
  const Node& node = *leaf.node;
  if (const auto* plane = std::get_if<Plane>(&node.geometry)) {
    notes_.add(fmt::format("planes are cut to squares with a side of {} times the scene's size",
                           kPlaneSide));
    try {
      return {cut_.square(*plane, leaf.map), {}};
    } catch (const InputError& error) {
      fail(node.place, fmt::format("'plane' can't be made: {}", error.what()));
    }
  }
  Solid solid = local_shape(leaf);
  if (leaf.moved) {
    solid.shape = make<Instance>(node.place, node.word, std::move(solid.shape), leaf.map);
  }
  return solid;
}

/// Rayshade shows surfaces from both sides. Solids have but one: what is closed around the eye, as
/// a room is, and a mesh that is wound inside out, is turned over.
ShapePtr Builder::seen_from_eye(ShapePtr shape) {
  const Vec3& eye = model_.view.eye;
  const bool may_contain = shape->unbounded() || shape->bounds().encloses({eye, eye});
  if (!shape->solid() || !may_contain || !shape->contains(eye)) return shape;
  if (!shape->unbounded()) notes_.add("what is closed around the eye is a room, seen from inside");
  return std::make_shared<Complement>(std::move(shape));
}

std::uint32_t Builder::material_of(const Surface& surface) {
  const auto& [r, g, b] = surface.diffuse;
  const auto index = static_cast<std::uint32_t>(scene_.materials.size());
  const auto [found, is_new] = materials_.try_emplace({surface.name, r, g, b}, index);
  if (!is_new) return found->second;
  if (max_channel(surface.diffuse) > kMostReflectance) {
    notes_.add(
        fmt::format("'diffuse' is at most {} here, so that light gets less at each reflection",
                    kMostReflectance));
  }
  const auto limited = [](double x) { return std::min(x, kMostReflectance); };
  scene_.materials.push_back(
      {material_names_.next(surface.name), {limited(r), limited(g), limited(b)}});
  return index;
}

std::string Builder::name_of(const Leaf& leaf) {
  if (leaf.name && leaf.alone) return object_names_.next(*leaf.name);
  const std::string prefix = leaf.name ? *leaf.name + ' ' : "";
  return object_names_.next(
      fmt::format("{}{} {}", prefix, leaf.node->word, scene_.objects.size() + 1));
}

Camera Builder::camera() const {
  const View& view = model_.view;
  const Vec3 forward = normalized(view.look_at - view.eye);
  if (!(length(cross(forward, normalized(view.up))) > 1e-6)) {
    const char* fault = "the view needs 'eyep' and 'lookp' apart, and 'up' not along it";
    if (view.place) fail(*view.place, fault);
    throw InputError(fault);
  }
  Camera camera;
  camera.name = "default";
  camera.eye = view.eye;
  camera.look_at = view.look_at;
  camera.up = view.up;
  camera.width = view.width;
  camera.height = view.height;
  using std::numbers::pi;
  const double half_width = std::tan(view.horizontal_fov * pi / 360);
  camera.fov =
      view.vertical_fov.value_or(std::atan(half_width * view.height / view.width) * 360 / pi);
  return camera;
}

/// Adds the object, or its parts where they have surfaces of their own.
void Builder::add(const Object& object, const Solid& solid, const Node& node) {
  if (solid.faces.size() > 1) split_runs_ += solid.faces.size();
  if (split_runs_ > kMostObjects) {
    fail(node.place, fmt::format("the solids of this scene have more than {} parts with surfaces "
                                 "of their own",
                                 kMostObjects));
  }
  try {
    for (Object& part : split_by_finish(object, solid.faces)) {
      scene_.objects.push_back(std::move(part));
    }
  } catch (const InputError& error) {
    fail(node.place, error.what());
  }
}

Scene Builder::build() {
  scene_.cameras.push_back(camera());
  for (const Leaf& leaf : leaves_) {
    const auto* facets = std::get_if<Facets>(&leaf.node->geometry);
    if (facets && facets->soup.triangles.empty()) continue;
    Object object;
    object.name = name_of(leaf);
    const Solid solid = shape_of(leaf);
    object.shape = seen_from_eye(solid.shape);
    if (solid.faces.empty() || std::any_of(solid.faces.begin(), solid.faces.end(),
                                           [](const FaceRun& run) { return !run.finish; })) {
      object.material = material_of(leaf.surface ? *leaf.surface : *default_surface());
    }
    object.sides = object.shape->solid() ? Sides::front : Sides::both;
    add(object, solid, *leaf.node);
  }
  add_lights(model_.lights, extent_, scene_, notes_);
  return std::move(scene_);
}

}  // namespace

Scene build_scene(const Model& model, Notes& notes) { return Builder(model, notes).build(); }

}  // namespace isolux::rayshade
