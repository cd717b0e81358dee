#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "isolux/radiosity/ball_view.h"
#include "isolux/radiosity/light_lattice.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// How closely shadows' edges are searched.
struct Precision {
  int halvings;      ///< of a lattice line in search of the shadow's edge
  int bow_halvings;  ///< of a quarter of the chord, in search of how far the edge bows out of it

  /// So that σ of a light that is partly seen is less than a quarter of the tolerance, times that
  /// light, even where an edge runs along its lattice and is off by the same on all lines.
  static Precision of(double tolerance);

  /// σ of a cut, in parts of the lattice line.
  double cut() const;
  /// σ of the seen part of a triangle that an edge cuts.
  double bent() const;
};

/// A receiver that looks at a light.
struct Viewer {
  Receiver receiver;
  Vec3 start;                    ///< of its rays, a hair above it
  std::optional<BallView> ball;  ///< where the light is one

  /// Where a point of the light's lattice is for it.
  Vec3 target(const Vec3& on_lattice) const { return ball ? ball->point(on_lattice) : on_lattice; }
  /// Whether that is on the part of a ball that its own horizon hides.
  bool below_horizon(const Vec3& on_lattice) const {
    return ball && !ball->above_horizon() && !(ball->cosine(on_lattice) > 0);
  }
};

/// How a shadow's edge runs through a triangle of a lattice: which corner is on one side alone, and
/// where, in parts of the sides, the edge cuts those that lead from it to the next and the last
/// corner.
struct EdgeCut {
  std::size_t odd;
  double next, last;
  bool odd_seen;

  /// The part of the triangle on the seen side of the chord between the cuts.
  double seen_part() const { return odd_seen ? next * last : 1 - next * last; }
};

/// Finds out by rays how much of one light a group of viewers sees; can be used again and again,
/// for its memory.
class ShadowSearch {
 public:
  enum class Seen { all, none, part };

  explicit ShadowSearch(const RayCaster& rays) : rays_(&rays) {}

  /// Asks rays, held against what may stand between, from the viewers to the points of the lattice;
  /// where these disagree, searches the shadow's edge on the lines between them. Returns what
  /// all of the viewers see alike. All arguments must outlive the use of the answers below. Lattice
  /// triangles of pieces that no viewer is in front of are left out.
  Seen search(const LightLattice& light, std::span<const Viewer> viewers, const Blockers& blockers,
              const Precision& precision);

  // Of viewer k, after `part` was returned; for triangles that it is in front of.

  /// How many corners of the triangle it sees.
  int seen_corners(std::size_t k, const LatticeTriangle& triangle) const;
  /// Where it sees one or two.
  EdgeCut cut_of(std::size_t k, const LatticeTriangle& triangle) const;
  /// What the bow of the edge adds to the odd corner's side, in parts of triangle t.
  double bow(std::size_t k, std::uint32_t t) const {
    return bow_[k * light_->triangles.size() + t];
  }

 private:
  using Index = std::uint32_t;
  struct Crossing {
    Index viewer, line;
    double s;
  };
  /// The search for how far the edge bows out of its chord in a triangle.
  struct Bow {
    Index viewer, triangle;
    Vec3 middle;   ///< of the chord
    Vec3 outward;  ///< away from the odd corner, across the chord and as long as it
    double s;      ///< the bow in parts of that
    bool odd_seen;
  };

  void choose_faced();
  void look(std::span<const Index> points);
  Seen first_glance() const;
  void search_edges(int halvings);
  void search_bows(int halvings);
  double cut(std::size_t k, const LatticeTriangle& triangle, std::size_t line, Index from) const;
  Bow chord_of(Index k, Index t) const;
  /// Whether something stands in the ways of `segments_`, into `blocked_`.
  void trace();
  std::uint8_t* open(std::size_t k) { return open_.data() + k * light_->points.size(); }
  const std::uint8_t* open(std::size_t k) const { return open_.data() + k * light_->points.size(); }

  const RayCaster* rays_;
  const LightLattice* light_ = nullptr;
  std::span<const Viewer> viewers_;
  const Blockers* blockers_ = nullptr;
  std::vector<Index> first_look_, second_look_, lines_, triangles_;  // of pieces that face anyone
  std::vector<std::uint8_t> open_;                                   // by viewer, then point
  std::vector<double> crossing_;                                     // by viewer, then line
  std::vector<Crossing> crossings_;
  std::vector<double> bow_;  // by viewer, then triangle: what the edge's bow adds, in parts of it
  std::vector<Bow> bows_;
  std::vector<std::uint8_t*> asked_;  // what of open_ waits for the rays' answers
  std::vector<std::uint8_t> wanted_;  // points and lines that are in a list already
  std::vector<Segment> segments_;
  std::vector<std::uint8_t> blocked_;
};

}  // namespace isolux
