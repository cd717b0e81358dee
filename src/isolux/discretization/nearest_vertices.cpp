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

/// The three nearest of those that face as `normal` does, to within the angle of this cosine, and
/// stand no further away than the mesh's longest edge.
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

  MeshPlace place() const {
    MeshPlace place;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      place.vertices[k] = nearest_[std::min(k, count_ - 1)].second;
      if (k < count_) sum += place.weights[k] = 1 / std::max(nearest_[k].first, 1e-200);
    }
    for (double& w : place.weights) w /= sum;
    return place;
  }

 private:
  const Places& places_;
  Vec3 normal_;
  double cosine_;
  double reach_;  // m²
  std::size_t count_ = 0;
  std::array<std::pair<double, VertexId>, 3> nearest_;  // m², nearest first
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

  std::optional<MeshPlace> place(const Vec3& point, const Vec3& normal) const {
    constexpr double kWithin60 = 0.5, kWithin90 = 1e-6;
    const std::array<double, 3> at{point.x, point.y, point.z};
    for (const double cosine : {kWithin60, kWithin90}) {
      Facing found(places_, normal, cosine);
      tree_.findNeighbors(found, at.data(), {});
      if (found.size() > 0) return found.place();
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
  return tree_->place(point, normal);
}

}  // namespace isolux
