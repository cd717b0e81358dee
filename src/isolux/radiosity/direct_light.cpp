#include "isolux/radiosity/direct_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/core/parallel.h"
#include "isolux/radiosity/form_factor.h"
#include "isolux/radiosity/light_lattice.h"
#include "isolux/radiosity/separate_lights.h"
#include "isolux/radiosity/source_light.h"
#include "isolux/radiosity/spatial_order.h"

namespace isolux {
namespace {

using Index = std::uint32_t;

/// How closely shadows' edges are searched.
struct Precision {
  int halvings;      ///< of a lattice line in search of the shadow's edge
  int bow_halvings;  ///< of a quarter of the chord, in search of how far the edge bows out of it

  /// So that σ of a light that is partly seen is less than a quarter of the tolerance, times that
  /// light, even where an edge runs along its lattice and is off by the same on all lines.
  static Precision of(double tolerance) {
    constexpr int kMost = 7, kFewerForBows = 2, kFewestForBows = 2;
    const double needed = std::log2(kSigma / kLines * 4 / std::max(tolerance, 1e-6));
    const int halvings = std::clamp(static_cast<int>(std::ceil(needed)), 1, kMost);
    return {halvings, std::max(kFewestForBows, halvings - kFewerForBows)};
  }

  /// σ of a cut, in parts of the lattice line.
  double cut() const { return std::ldexp(kSigma, -halvings); }
  /// σ of the seen part of a triangle that an edge cuts.
  double bent() const { return 0.007 + std::ldexp(0.1, -bow_halvings); }

 private:
  static constexpr double kSigma = 0.29;  // of a place anywhere between 0 and 1
  static constexpr int kLines = 8;        // of a lattice
};
constexpr double kBowReach = 0.125;
/// How many neighbours share shafts and doubts.
constexpr std::size_t kGroup = 32;

/// Whether some of the piece stands above the receiver's horizon, and the receiver before it.
bool may_see(const Piece& piece, const Receiver& receiver, double epsilon) {
  const double before = dot(receiver.point - piece.corners[0], piece.normal);
  if (before <= epsilon + piece.off) return false;
  return std::any_of(
      piece.corners.begin(), piece.corners.begin() + piece.corner_count,
      [&](const Vec3& corner) { return dot(corner - receiver.point, receiver.normal) > epsilon; });
}

/// The receivers in an order in which those that face alike and stand close together are
/// neighbours.
std::vector<Index> in_groups(std::span<const Receiver> receivers) {
  std::array<std::vector<Index>, 6> facing;  // by the axis that the normal is nearest to
  for (Index i = 0; i < receivers.size(); ++i) {
    const Vec3& n = receivers[i].normal;
    int axis = 0;
    for (int k = 1; k < 3; ++k) axis = std::abs(n[k]) > std::abs(n[axis]) ? k : axis;
    facing[static_cast<std::size_t>(2 * axis + (n[axis] < 0))].push_back(i);
  }
  std::vector<Index> order;
  std::vector<Vec3> points;
  for (const std::vector<Index>& alike : facing) {
    points.clear();
    for (const Index i : alike) points.push_back(receivers[i].point);
    for (const Index k : z_order(points)) order.push_back(alike[k]);
  }
  return order;
}

/// What is found out about one light by a group of receivers; kept for its memory.
class Group {
 public:
  Group(const RayCaster& rays, const LightLattice& light, std::span<const Receiver> receivers,
        const Precision& precision)
      : rays_(rays), light_(light), receivers_(receivers), precision_(precision) {}

  /// Adds the light to each receiver's irradiance, and to the variance of its luminance.
  void light_up(std::span<Rgb> irradiance, std::span<double> variance) {
    facing_.clear();
    Bounds starts;
    for (Index i = 0; i < receivers_.size(); ++i) {
      const bool sees = std::any_of(
          light_.pieces.begin(), light_.pieces.end(),
          [&](const Piece& piece) { return may_see(piece, receivers_[i], rays_.epsilon()); });
      if (!sees) continue;
      facing_.push_back(i);
      starts.include(receivers_[i].point);
    }
    if (facing_.empty()) return;
    blockers_ = rays_.blockers(starts, light_.bounds);
    const bool clear = blockers_.none();
    if (!clear) {
      const std::size_t n = light_.points.size();
      open_.assign(facing_.size() * n, 0);
      look(light_.first_look);
      if (doubtful()) {
        look(light_.second_look);
        search_edges();
        search_bows();
      }
    }
    for (std::size_t k = 0; k < facing_.size(); ++k) {
      const Index i = facing_[k];
      double factor = 0, spread = 0, shift = 0;
      for (const Piece& piece : light_.pieces) {
        if (!may_see(piece, receivers_[i], rays_.epsilon())) continue;
        add_piece(piece, k, clear, factor, spread, shift);
      }
      // Where an edge runs along the lattice, all its cuts are off by the same.
      spread += shift * shift;
      irradiance[i] += light_.exitance * factor;
      spread += light_.flatness * light_.flatness * factor * factor;
      const double m = luminance(light_.exitance);
      variance[i] += m * m * spread;
    }
  }

 private:
  const Receiver& receiver(std::size_t k) const { return receivers_[facing_[k]]; }
  Vec3 start(std::size_t k) const {
    return receiver(k).point + receiver(k).normal * rays_.epsilon();
  }
  std::uint8_t* open(std::size_t k) { return open_.data() + k * light_.points.size(); }

  /// Rays from all to these points; all to one point together, since such rays run close.
  void look(std::span<const Index> points) {
    segments_.clear();
    for (const Index p : points) {
      for (std::size_t k = 0; k < facing_.size(); ++k) {
        segments_.push_back({start(k), light_.points[p]});
      }
    }
    blocked_.resize(segments_.size());
    rays_.occluded(blockers_, segments_, blocked_);
    std::size_t ray = 0;
    for (const Index p : points) {
      for (std::size_t k = 0; k < facing_.size(); ++k) open(k)[p] = !blocked_[ray++];
    }
  }

  int seen_corners(std::size_t k, const LatticeTriangle& triangle) const {
    const std::uint8_t* open = open_.data() + k * light_.points.size();
    return open[triangle.points[0]] + open[triangle.points[1]] + open[triangle.points[2]];
  }

  /// Whether the group does not see all of the light, or nothing of it, as one man.
  bool doubtful() {
    const std::uint8_t seen = open(0)[light_.first_look[0]];
    for (std::size_t k = 0; k < facing_.size(); ++k) {
      for (const Index p : light_.first_look) {
        if (open(k)[p] != seen) {
          all_alike_ = false;
          return true;
        }
      }
    }
    all_alike_ = true;
    all_seen_ = seen;
    return false;
  }

  /// On each line between a seen and a hidden point, where the one begins to be the other.
  void search_edges() {
    const std::size_t n = light_.lines.size();
    crossing_.assign(facing_.size() * n, 0);
    crossings_.clear();
    for (std::size_t k = 0; k < facing_.size(); ++k) {
      for (Index l = 0; l < n; ++l) {
        const LatticeLine& line = light_.lines[l];
        if (open(k)[line.from] != open(k)[line.to]) {
          crossings_.push_back({static_cast<Index>(k), l, 0});
        }
      }
    }
    double step = 0.5;
    blocked_.resize(crossings_.size());
    for (int round = 0; round < precision_.halvings; ++round, step /= 2) {
      segments_.clear();
      for (const Crossing& c : crossings_) {
        segments_.push_back({start(c.receiver), light_.at(light_.lines[c.line], c.s + step)});
      }
      rays_.occluded(blockers_, segments_, blocked_);
      for (std::size_t i = 0; i < crossings_.size(); ++i) {
        Crossing& c = crossings_[i];
        const bool as_start =
            (blocked_[i] == 0) == (open(c.receiver)[light_.lines[c.line].from] != 0);
        if (as_start) c.s += step;
      }
    }
    for (const Crossing& c : crossings_) crossing_[c.receiver * n + c.line] = c.s + step;
  }

  /// In each triangle that the edge cuts, how far it bows out of the chord between the two cuts.
  void search_bows() {
    const std::size_t n = light_.triangles.size();
    bow_.assign(facing_.size() * n, 0);
    bows_.clear();
    for (std::size_t k = 0; k < facing_.size(); ++k) {
      for (Index t = 0; t < n; ++t) {
        if (const int seen = seen_corners(k, light_.triangles[t]); seen == 1 || seen == 2) {
          bows_.push_back(chord_of(static_cast<Index>(k), t));
        }
      }
    }
    double step = kBowReach;
    blocked_.resize(bows_.size());
    for (int round = 0; round < precision_.bow_halvings; ++round, step /= 2) {
      segments_.clear();
      for (const Bow& bow : bows_) {
        segments_.push_back({start(bow.receiver), bow.middle + bow.outward * bow.s});
      }
      rays_.occluded(blockers_, segments_, blocked_);
      for (std::size_t i = 0; i < bows_.size(); ++i) {
        const bool as_tip = (blocked_[i] == 0) == bows_[i].odd_seen;
        bows_[i].s += as_tip ? step / 2 : -step / 2;
      }
    }
    for (const Bow& bow : bows_) {
      // A parabola over its chord has two thirds of the box around it.
      const double area = 2. / 3 * bow.s * length_squared(bow.outward);
      bow_[bow.receiver * n + bow.triangle] = area / light_.triangles[bow.triangle].area;
    }
  }

  /// Where the edge cuts line k of the triangle, in parts of the line from its point `from`.
  double cut(std::size_t k, const LatticeTriangle& triangle, std::size_t line, Index from) const {
    const Index l = triangle.lines[line];
    const double s = crossing_[k * light_.lines.size() + l];
    return light_.lines[l].from == from ? s : 1 - s;
  }

  /// How a shadow's edge runs through a triangle: which corner is on one side alone, and where, in
  /// parts of the sides, the edge cuts those that lead from it to the next and the last corner.
  struct EdgeCut {
    std::size_t odd;
    double next, last;
    bool odd_seen;
  };
  EdgeCut cut_of(std::size_t k, const LatticeTriangle& triangle) const {
    const auto seen = [&](std::size_t corner) {
      return open_[k * light_.points.size() + triangle.points[corner]] != 0;
    };
    const std::size_t odd = seen(0) == seen(1) ? 2 : seen(1) == seen(2) ? 0 : 1;
    const Index tip = triangle.points[odd];
    return {odd, cut(k, triangle, odd, tip), cut(k, triangle, (odd + 2) % 3, tip), seen(odd)};
  }

  /// Adds the form factor of what is seen of the piece, the variance of that, and the σ that its
  /// cuts share with those of other pieces.
  void add_piece(const Piece& piece, std::size_t k, bool clear, double& factor, double& variance,
                 double& shift) {
    constexpr double kBowDoubt = 0.35;
    const Receiver& r = receiver(k);
    if (!clear && all_alike_ && !all_seen_) return;
    if (clear || all_alike_) {
      factor += form_factor(r.point, r.normal, piece.polygon());
      return;
    }
    // Far away the closed form of the whole counts, times the part that is seen by the measure of
    // thin pencils: cos cos' / r² changes so little within a lattice triangle that its middle
    // stands for it. Near by, or on the horizon, each seen part is measured by itself.
    const bool thin = !near(piece, r);
    double whole = 0, seen = 0, spread = 0, shared = 0;
    for (Index t = piece.first; t < piece.end; ++t) {
      const LatticeTriangle& triangle = light_.triangles[t];
      const int corners = seen_corners(k, triangle);
      if (!thin && corners == 0) continue;
      const double weight = thin ? pencil(triangle, r) : exact(triangle, r);
      whole += weight;
      if (corners == 3) seen += weight;
      if (corners == 0 || corners == 3) continue;
      const EdgeCut cut = cut_of(k, triangle);
      const double bow = bow_[k * light_.triangles.size() + t] * (cut.odd_seen ? 1 : -1);
      const double part = cut.odd_seen ? cut.next * cut.last : 1 - cut.next * cut.last;
      seen += thin ? weight * part : exact_part(triangle, cut, r);
      seen += weight * (std::clamp(part + bow, 0.0, 1.0) - part);
      const double bent = weight * (precision_.bent() + kBowDoubt * std::abs(bow));
      spread += bent * bent;
      shared += weight * (cut.next + cut.last) * precision_.cut();
    }
    if (!(seen > 0)) return;
    const double scale = thin ? form_factor(r.point, r.normal, piece.polygon()) / whole : 1;
    factor += scale * seen;
    variance += scale * scale * spread;
    shift += scale * shared;
  }

  /// Whether the lattice is coarse as seen from here, or the horizon cuts it.
  static bool near(const Piece& piece, const Receiver& r) {
    const double size = distance(piece.corners[0], piece.corners[2]);
    return distance((piece.corners[0] + piece.corners[2]) * 0.5, r.point) < 1.5 * size ||
           std::any_of(piece.polygon().begin(), piece.polygon().end(),
                       [&](const Vec3& corner) { return dot(corner - r.point, r.normal) <= 0; });
  }

  double exact(const LatticeTriangle& triangle, const Receiver& r) const {
    const auto& [a, b, c] = triangle.points;
    const std::array<Vec3, 3> corners{light_.points[a], light_.points[b], light_.points[c]};
    return form_factor(r.point, r.normal, corners);
  }

  double exact_part(const LatticeTriangle& triangle, const EdgeCut& cut, const Receiver& r) const {
    const Vec3& tip = light_.points[triangle.points[cut.odd]];
    const Vec3& next = light_.points[triangle.points[(cut.odd + 1) % 3]];
    const Vec3& last = light_.points[triangle.points[(cut.odd + 2) % 3]];
    const Vec3 on_next = tip + (next - tip) * cut.next, on_last = tip + (last - tip) * cut.last;
    if (cut.odd_seen) return form_factor(r.point, r.normal, std::array{tip, on_next, on_last});
    return form_factor(r.point, r.normal, std::array{on_next, next, last, on_last});
  }

  /// cos cos' A / (π r²) of the triangle's middle.
  double pencil(const LatticeTriangle& triangle, const Receiver& r) const {
    const auto& [a, b, c] = triangle.points;
    const Vec3 d = (light_.points[a] + light_.points[b] + light_.points[c]) / 3 - r.point;
    const double squared = length_squared(d);
    return std::max(0.0, dot(d, r.normal)) * std::max(0.0, -dot(d, triangle.normal)) *
           triangle.area / (std::numbers::pi * squared * squared);
  }

  /// The search for how far the edge bows out of its chord in a triangle.
  struct Bow {
    Index receiver, triangle;
    Vec3 middle;   ///< of the chord
    Vec3 outward;  ///< away from the odd corner, across the chord and as long as it
    double s;      ///< the bow in parts of that
    bool odd_seen;
  };
  Bow chord_of(Index k, Index t) const {
    const LatticeTriangle& triangle = light_.triangles[t];
    const EdgeCut cut = cut_of(k, triangle);
    const Vec3& tip = light_.points[triangle.points[cut.odd]];
    const Vec3 a = tip + (light_.points[triangle.points[(cut.odd + 1) % 3]] - tip) * cut.next;
    const Vec3 b = tip + (light_.points[triangle.points[(cut.odd + 2) % 3]] - tip) * cut.last;
    return {k, t, (a + b) * 0.5, cross(b - a, triangle.normal), 0, cut.odd_seen};
  }

  struct Crossing {
    Index receiver, line;
    double s;
  };

  const RayCaster& rays_;
  const LightLattice& light_;
  std::span<const Receiver> receivers_;
  const Precision precision_;
  std::vector<Index> facing_;
  bool all_alike_ = false, all_seen_ = false;
  std::vector<std::uint8_t> open_;  // by receiver, then point
  std::vector<double> crossing_;    // by receiver, then line
  std::vector<Crossing> crossings_;
  std::vector<double> bow_;  // by receiver, then triangle: what the edge's bow adds, in parts of it
  std::vector<Bow> bows_;
  Blockers blockers_;  // that may stand between the group and the light
  std::vector<Segment> segments_;
  std::vector<std::uint8_t> blocked_;
};

}  // namespace

DirectLight::DirectLight(const RayCaster& rays)
    : rays_(rays), separate_(separate_lights(rays.scene())) {
  const Scene& scene = rays.scene();
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!separate_[i]) continue;
    const Object& object = scene.objects[i];
    lights_.push_back(lattice_of(object, rays.epsilon()));
  }
}

void DirectLight::irradiance(std::span<const Receiver> receivers, std::span<Rgb> irradiance,
                             std::span<double> error, double tolerance,
                             const std::function<bool()>& keep_going) const {
  const std::vector<Index> order = in_groups(receivers);
  const Precision precision = Precision::of(tolerance);
  const auto light_group = [&](std::span<const Index> members) {
    const std::size_t n = members.size();
    std::array<Receiver, kGroup> group;
    std::array<Rgb, kGroup> sum{};
    std::array<double, kGroup> variance{};
    for (std::size_t i = 0; i < n; ++i) group[i] = receivers[members[i]];
    for (const auto& light : lights_) {
      Group(rays_, *light, std::span(group).first(n), precision).light_up(sum, variance);
    }
    for (const Source& source : rays_.scene().sources) {
      add_source_light(rays_, source, std::span(group).first(n), sum);
    }
    for (std::size_t i = 0; i < n; ++i) {
      irradiance[members[i]] = sum[i];
      error[members[i]] = std::sqrt(variance[i]);
    }
  };
  constexpr std::size_t kBetweenLooks = 64 * kGroup;
  for (std::size_t first = 0; first < order.size(); first += kBetweenLooks) {
    if (keep_going && !keep_going()) return;
    const auto some =
        std::span(order).subspan(first, std::min(kBetweenLooks, order.size() - first));
    parallel_for(some.size(), kGroup, [&](std::size_t begin, std::size_t end) {
      light_group(some.subspan(begin, end - begin));
    });
  }
}

}  // namespace isolux
