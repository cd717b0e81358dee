#pragma once

#include <unordered_map>
#include <vector>

#include "isolux/core/affine.h"
#include "isolux/raycast/embree_device.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// An object as Embree sees it.
struct Primitive {
  const Object* object;
  std::uint32_t index;
  bool both_sides;
};

/// Embree's tree over the objects of a scene, down to the parts of their shapes. A shape of many
/// parts that stands in several places has a tree of its own, but once. The boxes have room for
/// rays that are rounded to single precision.
class ObjectTree {
 public:
  /// The callbacks learn from primitive() which object they are about. The scene must outlive this.
  ObjectTree(const Scene& scene, RTCIntersectFunctionN intersect, RTCOccludedFunctionN occluded);
  ~ObjectTree();
  ObjectTree(const ObjectTree&) = delete;
  ObjectTree& operator=(const ObjectTree&) = delete;

  RTCScene rtc() const { return rtc_; }
  /// Whether some shape has a tree of its own.
  bool has_shared() const { return !shared_.empty(); }
  /// The object that a callback is about, by what Embree hands to it.
  const Primitive& primitive(const RTCIntersectContext& context, const void* geometry_data) const;
  const std::vector<Primitive>& primitives() const { return primitives_; }

 private:
  /// A shape with a tree of its own.
  struct Shared {
    const Shape* shape;
    double room = 0;  ///< m in the shape's frame, that rays may be off once they are mapped there
    RTCScene rtc = nullptr;
  };

  void make_shared_trees(const Scene& scene);
  void attach(const Primitive& primitive);
  void attach_instance(unsigned id, const Shared& shared, const Affine& map);
  void attach_parts(RTCScene to, unsigned id, const Shape& shape, RTCBoundsFunction bounds,
                    const void* data);
  static void primitive_bounds(const RTCBoundsFunctionArguments* args);
  static void shared_bounds(const RTCBoundsFunctionArguments* args);

  RTCIntersectFunctionN intersect_;
  RTCOccludedFunctionN occluded_;
  std::shared_ptr<RTCDeviceTy> device_ = embree_device();
  RTCScene rtc_ = nullptr;
  std::vector<Primitive> primitives_;                ///< by object; Embree holds pointers to them
  std::unordered_map<const Shape*, Shared> shared_;  ///< likewise
};

}  // namespace isolux
