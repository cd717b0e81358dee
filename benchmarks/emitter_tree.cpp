#include "emitter_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "isolux/core/random.h"

namespace isolux {
namespace {

constexpr std::size_t kMostReceivers = 32;

// Visibility rays to a node that may be hidden: at first, and more where these disagree.
constexpr int kFewRays = 4, kMoreRays = 12;

// A node seen this large (radius over distance) is opened whatever it sends.
constexpr double kLargest = 0.9;

// A node that may be half hidden is opened where it sends more than this many ε.
constexpr double kHidden = 8;

}  // namespace

EmitterTree::EmitterTree(const RayCaster& rays, const Triangulation& mesh,
                         std::span<const std::uint8_t> separate)
    : rays_(rays), mesh_(mesh), separate_(separate.begin(), separate.end()) {
  for (TriangleId t = 0; t < mesh.triangles().size(); ++t) {
    if (mesh.triangle(t).alive) triangles_.push_back(t);
  }
  // The two sides of an open surface, and the walls of a box, are different surfaces.
  const auto surface = [&](TriangleId t) {
    const SurfaceId s = mesh.vertex(mesh.triangle(t).vertices[0]).surface;
    const Vec3& n = mesh.triangle(t).normal;
    return std::tuple(s.object, s.face, n.x + 2 * n.y + 3 * n.z > 0);
  };
  std::stable_sort(triangles_.begin(), triangles_.end(),
                   [&](TriangleId a, TriangleId b) { return surface(a) < surface(b); });
  const auto n = static_cast<std::uint32_t>(triangles_.size());
  for (std::uint32_t first = 0, end = 0; first < n; first = end) {
    while (end < n && surface(triangles_[end]) == surface(triangles_[first])) ++end;
    roots_.push_back(static_cast<std::uint32_t>(nodes_.size()));
    nodes_.emplace_back();
    nodes_.back().first = first;
    nodes_.back().count = end - first;
  }
  for (const std::uint32_t root : roots_) divide(root);
  double sum = 0;
  for (const TriangleId t : triangles_) {
    area_up_to_.push_back(sum += mesh.triangle(t).area);
    emitters_.push_back(emitter_of(mesh, t));
  }
}

void EmitterTree::fill(Node& node) const {
  const auto triangles = std::span(triangles_).subspan(node.first, node.count);
  Vec3 moment;
  for (const TriangleId id : triangles) {
    const Triangle& t = mesh_.triangle(id);
    node.area += t.area;
    node.vector_area += t.normal * t.area;
    for (VertexId v : t.vertices) {
      node.bounds.include(mesh_.vertex(v).position);
      moment += mesh_.vertex(v).position * (t.area / 3);
    }
  }
  node.center = moment / node.area;
  node.normal = normalized(node.vector_area);
  node.low = std::numeric_limits<double>::infinity();
  for (const TriangleId id : triangles) {
    const Triangle& t = mesh_.triangle(id);
    node.cone = std::min(node.cone, dot(t.normal, node.normal));
    for (VertexId v : t.vertices) {
      const Vec3& p = mesh_.vertex(v).position;
      node.low = std::min(node.low, dot(node.normal, p));
      node.radius = std::max(node.radius, distance(p, node.center));
    }
  }
}

/// Halves the node along its longest side, down to single triangles.
void EmitterTree::divide(std::uint32_t index) {
  fill(nodes_[index]);
  const auto [first, count] = std::pair(nodes_[index].first, nodes_[index].count);
  if (count == 1) return;
  const auto middle = [&](TriangleId t) {
    Vec3 sum;
    for (VertexId v : mesh_.triangle(t).vertices) sum += mesh_.vertex(v).position;
    return sum / 3;
  };
  const auto begin = triangles_.begin() + first;
  Bounds middles;
  for (auto t = begin; t != begin + count; ++t) middles.include(middle(*t));
  const Vec3 size = middles.upper - middles.lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](TriangleId a, TriangleId b) {
    return std::pair(middle(a)[axis], a) < std::pair(middle(b)[axis], b);
  });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[index].child = child;
  nodes_.resize(nodes_.size() + 2);
  nodes_[child].first = first, nodes_[child].count = half;
  nodes_[child + 1].first = first + half, nodes_[child + 1].count = count - half;
  divide(child);
  divide(child + 1);
}

std::vector<double> EmitterTree::radiosities(std::span<const Rgb> irradiance) const {
  std::vector<double> result(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // children come after their parents
    const Node& node = nodes_[i];
    if (node.child) {
      const Node &a = nodes_[node.child], &b = nodes_[node.child + 1];
      result[i] = (result[node.child] * a.area + result[node.child + 1] * b.area) / node.area;
      continue;
    }
    const Triangle& t = mesh_.triangle(triangles_[node.first]);
    Rgb sum = separate_[mesh_.vertex(t.vertices[0]).surface.object] ? Rgb{} : t.emission;
    for (VertexId v : t.vertices) sum += mesh_.vertex(v).reflectance * irradiance[v] / 3;
    result[i] = luminance(sum);
  }
  return result;
}

/// The tree on its way to being opened for one group of receivers.
class EmitterTree::Opening {
 public:
  Opening(const EmitterTree& tree, std::span<const Receiver> group,
          std::span<const double> radiosity, double epsilon, std::uint64_t seed,
          std::span<std::vector<Link>> rows)
      : tree_(tree),
        group_(group),
        radiosity_(radiosity),
        epsilon_(epsilon),
        random_(seed, 0),
        rows_(rows) {
    for (const Receiver& r : group) from_.include(r.point);
  }

  /// Goes down from a node, for the receivers of these indices.
  void open(std::uint32_t index, std::vector<std::uint32_t> receivers) {
    const Node& node = tree_.nodes_[index];
    bool whole = true;  // every receiver sees the front of all of it above its horizon
    double nearest = std::numeric_limits<double>::infinity();
    std::erase_if(receivers,
                  [&](std::uint32_t i) { return !faces(node, group_[i], whole, nearest); });
    if (receivers.empty()) return;
    const double ratio = node.radius / nearest;
    const double share =
        std::min(1.0, node.area / (std::numbers::pi * nearest * nearest)) * radiosity_[index];
    const double off = share * (ratio * ratio / 2 + (whole ? 0 : std::min(1.0, ratio)));
    bool down = ratio > kLargest || off > epsilon_;
    Blockers blockers;
    if (!down || node.child == 0) {
      Bounds to = node.bounds;
      if (!node.flat()) {  // the true surface stands out over the triangles
        const Vec3 more = Vec3{1, 1, 1} * (0.1 * node.radius);
        to = {to.lower - more, to.upper + more};
      }
      blockers = tree_.rays_.blockers(from_, to);
      down = down || (!blockers.none() && share > kHidden * epsilon_);
    }
    if (node.child && down) {
      open(node.child, receivers);
      open(node.child + 1, std::move(receivers));
    } else {
      link(index, blockers, share, receivers);
    }
  }

  std::uint64_t ray_count = 0;

 private:
  bool faces(const Node& node, const Receiver& r, bool& whole, double& nearest) const {
    const double hair = 2 * tree_.rays_.epsilon();
    const Vec3 half = (node.bounds.upper - node.bounds.lower) / 2;
    const double reach = std::abs(r.normal.x) * half.x + std::abs(r.normal.y) * half.y +
                         std::abs(r.normal.z) * half.z;
    const double height = dot(node.bounds.center() - r.point, r.normal);
    if (height + reach <= hair) return false;
    if (node.flat() && dot(node.normal, r.point) - node.low <= hair) return false;
    const Vec3 d = r.point - node.center;
    const double away = length(d);
    nearest = std::min(nearest, away);
    const double turned = std::sqrt(std::max(0.0, 1 - node.cone * node.cone));
    whole = whole && height >= reach &&
            (node.flat() || dot(d, node.normal) >= turned * away + node.radius);
    return true;
  }

  void link(std::uint32_t index, const Blockers& blockers, double share,
            std::vector<std::uint32_t>& receivers) {
    const Node& node = tree_.nodes_[index];
    std::array<double, kMostReceivers> factors{};
    if (node.child) {
      for (const std::uint32_t i : receivers) {
        const Vec3 d = node.center - group_[i].point;
        factors[i] = std::max(0.0, dot(d, group_[i].normal)) *
                     std::max(0.0, -dot(d, node.vector_area)) /
                     (std::numbers::pi * length_squared(d) * length_squared(d));
      }
    } else {
      const auto& corners = tree_.emitters_[node.first].corners;
      form_factors(group_, receivers, corners, factors);
      for (const std::uint32_t i : receivers) {  // its back sends nothing
        if (dot(group_[i].point - corners[0], node.normal) <= 0) factors[i] = 0;
      }
    }
    std::erase_if(receivers, [&](std::uint32_t i) { return factors[i] <= 0; });
    const auto add = [&](std::uint32_t i, double part) {
      if (part > 0) rows_[i].push_back({index, static_cast<float>(factors[i] * part)});
    };
    if (blockers.none()) {
      for (const std::uint32_t i : receivers) add(i, 1);
      return;
    }
    const int few = share < epsilon_ / 2 ? 1 : share < 2 * epsilon_ ? 2 : kFewRays;
    std::array<int, kMostReceivers> seen{};
    look(node, blockers, few, receivers, seen);
    std::vector<std::uint32_t> divided;
    for (const std::uint32_t i : receivers) {
      if (few == kFewRays && seen[i] > 0 && seen[i] < few) {
        divided.push_back(i);
      } else {
        add(i, double(seen[i]) / few);
      }
    }
    look(node, blockers, kMoreRays, divided, seen);
    for (const std::uint32_t i : divided) add(i, double(seen[i]) / (kFewRays + kMoreRays));
  }

  /// Adds to seen[i] how many of `count` rays from receiver i reach the node.
  void look(const Node& node, const Blockers& blockers, int count,
            std::span<const std::uint32_t> receivers, std::span<int> seen) {
    segments_.clear();
    for (int j = 0; j < count; ++j) {
      for (const std::uint32_t i : receivers) {
        const Receiver& r = group_[i];
        segments_.push_back({r.point + r.normal * tree_.rays_.epsilon(),
                             point_of(node, (j + random_.uniform()) / count)});
      }
    }
    blocked_.resize(segments_.size());
    tree_.rays_.occluded(blockers, segments_, blocked_);
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      seen[receivers[s % receivers.size()]] += !blocked_[s];
    }
    ray_count += segments_.size();
  }

  /// A point of the true surface over the node: of its area up to `part` in the tree's order.
  Vec3 point_of(const Node& node, double part) {
    const auto first = tree_.area_up_to_.begin() + node.first;
    const double before = node.first ? *(first - 1) : 0;
    const auto at = std::lower_bound(first, first + node.count - 1, before + part * node.area);
    const Emitter& e = tree_.emitters_[static_cast<std::size_t>(at - tree_.area_up_to_.begin())];
    const double s = std::sqrt(random_.uniform()), w = random_.uniform();
    const double b0 = 1 - s, b1 = s * (1 - w), b2 = s * w;
    const double lift = b0 * b1 * e.bulge[0] + b1 * b2 * e.bulge[1] + b2 * b0 * e.bulge[2];
    return e.corners[0] * b0 + e.corners[1] * b1 + e.corners[2] * b2 +
           e.normal * (lift + tree_.rays_.epsilon());
  }

  const EmitterTree& tree_;
  std::span<const Receiver> group_;
  std::span<const double> radiosity_;
  double epsilon_;
  Random random_;
  std::span<std::vector<Link>> rows_;
  Bounds from_;
  std::vector<Segment> segments_;
  std::vector<std::uint8_t> blocked_;
};

std::uint64_t EmitterTree::link(std::span<const Receiver> group, std::span<const double> radiosity,
                                double epsilon, std::uint64_t seed,
                                std::span<std::vector<Link>> rows) const {
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < std::min(group.size(), kMostReceivers); ++i) all.push_back(i);
  Opening opening(*this, group, radiosity, epsilon, seed, rows);
  for (const std::uint32_t root : roots_) opening.open(root, all);
  return opening.ray_count;
}

}  // namespace isolux
