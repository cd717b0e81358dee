#include "isolux/discretization/nearest_vertices.h"

#include <nanoflann.hpp>

namespace isolux {
namespace {

/// What the tree reads vertices by; a copy, so that it is close together in memory.
struct Places {
  struct Place {
    std::array<double, 3> position;  // m
    Vec3 normal;
    VertexId vertex;
  };
  double max_edge;            // of the mesh, m
  std::vector<Place> places;  // of the vertices of living triangles

  std::size_t kdtree_get_point_count() const { return places.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t dimension) const {
    return places[i].position[dimension];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// The nearest of those that face as `normal` does, to within the angle of this cosine, and stand
/// no further away than the mesh's longest edge.
template <std::size_t kMost>
class Facing {
 public:
  using DistanceType = double;

  Facing(const Places& places, const Vec3& normal, double cosine)
      : places_(places),
        normal_(normal),
        cosine_(cosine),
        reach_(places.max_edge * places.max_edge) {}

  std::size_t size() const { return count_; }
  bool full() const { return count_ == nearest_.size(); }
  double worstDist() const { return full() ? nearest_.back().first : reach_; }
  bool addPoint(double squared, std::size_t i) {
    const Places::Place& place = places_.places[i];
    const bool facing = dot(place.normal, normal_) >= cosine_;
    if (!facing || squared >= worstDist()) return true;
    count_ += !full();
    std::size_t k = count_ - 1;
    for (; k > 0 && nearest_[k - 1].first > squared; --k) nearest_[k] = nearest_[k - 1];
    nearest_[k] = {squared, place.vertex};
    return true;
  }

  /// The first three that `seen` is true of.
  template <typename Seen>
  std::optional<MeshPlace> place(const Seen& seen) const {
    MeshPlace place;
    std::size_t found = 0;
    double sum = 0;
    for (std::size_t k = 0; k < count_ && found < 3; ++k) {
      const auto& [squared, v] = nearest_[k];
      if (!seen(v)) continue;
      for (std::size_t rest = found; rest < 3; ++rest) place.vertices[rest] = v;
      sum += place.weights[found++] = 1 / std::max(squared, 1e-200);
    }
    if (found == 0) return std::nullopt;
    for (double& w : place.weights) w /= sum;
    return place;
  }

 private:
  const Places& places_;
  Vec3 normal_;
  double cosine_;
  double reach_;  // m²
  std::size_t count_ = 0;
  std::array<std::pair<double, VertexId>, kMost> nearest_;  // m², nearest first
};

}  // namespace

class NearestVertices::Tree {
 public:
  explicit Tree(const Triangulation& mesh) : places_{mesh.rules().max_edge, {}}, tree_(3, places_) {
    for (VertexId v = 0; v < mesh.vertices().size(); ++v) {
      if (mesh.vertex(v).triangles.empty()) continue;
      const auto& [x, y, z] = mesh.vertex(v).position;
      places_.places.push_back({{x, y, z}, mesh.vertex(v).normal, v});
    }
    tree_.buildIndex();
  }

  template <std::size_t kAmong, typename Seen>
  std::optional<MeshPlace> place(const Vec3& point, const Vec3& normal, const Seen& seen) const {
    constexpr double kWithin60 = 0.5, kWithin90 = 1e-6;
    const std::array<double, 3> at{point.x, point.y, point.z};
    for (const double cosine : {kWithin60, kWithin90}) {
      Facing<kAmong> found(places_, normal, cosine);
      tree_.findNeighbors(found, at.data(), {});
      if (found.size() > 0) return found.place(seen);
    }
    return std::nullopt;
  }

 private:
  using Metric = nanoflann::L2_Simple_Adaptor<double, Places>;

  Places places_;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Places, 3> tree_;
};

NearestVertices::NearestVertices(const Triangulation& mesh) : tree_(std::make_unique<Tree>(mesh)) {}
NearestVertices::~NearestVertices() = default;

std::optional<MeshPlace> NearestVertices::place(const Vec3& point, const Vec3& normal) const {
  return tree_->place<3>(point, normal, [](VertexId) { return true; });
}

std::optional<MeshPlace> NearestVertices::place(const Vec3& point, const Vec3& normal,
                                                const std::function<bool(VertexId)>& seen) const {
  return tree_->place<16>(point, normal, seen);
}

}  // namespace isolux
