#include "isolux/radiosity/shadow_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace isolux {
namespace {

using Index = std::uint32_t;

constexpr double kSigma = 0.29;  // of a place anywhere between 0 and 1
constexpr int kLines = 8;        // of a lattice
constexpr double kBowReach = 0.125;

/// Whether one of the viewers may be in front of the piece.
bool faces_any(const Piece& piece, std::span<const Viewer> viewers, double epsilon) {
  return std::any_of(viewers.begin(), viewers.end(), [&](const Viewer& viewer) {
    return piece.before(viewer.receiver.point) > epsilon;
  });
}

}  // namespace

Precision Precision::of(double tolerance) {
  constexpr int kMost = 7, kFewerForBows = 2, kFewestForBows = 2;
  const double needed = std::log2(kSigma / kLines * 4 / std::max(tolerance, 1e-6));
  const int halvings = std::clamp(static_cast<int>(std::ceil(needed)), 1, kMost);
  return {halvings, std::max(kFewestForBows, halvings - kFewerForBows)};
}

double Precision::cut() const { return std::ldexp(kSigma, -halvings); }

double Precision::bent() const { return 0.007 + std::ldexp(0.1, -bow_halvings); }

ShadowSearch::Seen ShadowSearch::search(const LightLattice& light, std::span<const Viewer> viewers,
                                        const Blockers& blockers, const Precision& precision) {
  light_ = &light;
  viewers_ = viewers;
  blockers_ = &blockers;
  choose_faced();
  open_.assign(viewers.size() * light.points.size(), 0);
  look(first_look_);
  if (const Seen seen = first_glance(); seen != Seen::part) return seen;
  look(second_look_);
  search_edges(precision.halvings);
  search_bows(precision.bow_halvings);
  return Seen::part;
}

/// Lists the triangles of pieces that some viewer is in front of, with their points and lines.
void ShadowSearch::choose_faced() {
  const std::vector<Piece>& pieces = light_->pieces;
  triangles_.clear();
  for (const Piece& piece : pieces) {
    if (!faces_any(piece, viewers_, rays_->epsilon())) continue;
    for (Index t = piece.first; t < piece.end; ++t) triangles_.push_back(t);
  }
  if (pieces.empty() || triangles_.size() == light_->triangles.size()) {
    first_look_ = light_->first_look, second_look_ = light_->second_look;
    lines_.resize(light_->lines.size());
    triangles_.resize(light_->triangles.size());
    std::iota(lines_.begin(), lines_.end(), 0);
    std::iota(triangles_.begin(), triangles_.end(), 0);
    return;
  }
  const auto points = static_cast<Index>(light_->points.size());
  wanted_.assign(points + light_->lines.size(), 0);
  lines_.clear();
  for (const Index t : triangles_) {
    for (const Index p : light_->triangles[t].points) wanted_[p] = 1;
    for (const Index l : light_->triangles[t].lines) {
      if (!std::exchange(wanted_[points + l], 1)) lines_.push_back(l);
    }
  }
  const auto keep = [&](const std::vector<Index>& all, std::vector<Index>& kept) {
    kept.clear();
    std::copy_if(all.begin(), all.end(), std::back_inserter(kept),
                 [&](Index p) { return wanted_[p] != 0; });
  };
  keep(light_->first_look, first_look_);
  keep(light_->second_look, second_look_);
}

void ShadowSearch::trace() {
  blocked_.resize(segments_.size());
  rays_->occluded(*blockers_, segments_, blocked_);
}

/// Rays from all to these points; all to one point together, since such rays run close. What a
/// viewer's horizon hides counts as seen: it is given no weight.
void ShadowSearch::look(std::span<const Index> points) {
  segments_.clear();
  asked_.clear();
  for (const Index p : points) {
    for (std::size_t k = 0; k < viewers_.size(); ++k) {
      open(k)[p] = 1;
      if (viewers_[k].below_horizon(light_->points[p])) continue;
      segments_.push_back({viewers_[k].start, viewers_[k].target(light_->points[p])});
      asked_.push_back(open(k) + p);
    }
  }
  trace();
  for (std::size_t i = 0; i < asked_.size(); ++i) *asked_[i] = !blocked_[i];
}

/// Whether after the first look the group has seen all of the light, or nothing of it, as one man.
ShadowSearch::Seen ShadowSearch::first_glance() const {
  const auto blocked = std::count(blocked_.begin(), blocked_.end(), 0) == 0;
  if (blocked) return Seen::none;
  return std::find(blocked_.begin(), blocked_.end(), 1) == blocked_.end() ? Seen::all : Seen::part;
}

/// On each line between a seen and a hidden point, where the one begins to be the other.
void ShadowSearch::search_edges(int halvings) {
  const std::size_t n = light_->lines.size();
  crossing_.assign(viewers_.size() * n, 0);
  crossings_.clear();
  for (std::size_t k = 0; k < viewers_.size(); ++k) {
    for (const Index l : lines_) {
      const LatticeLine& line = light_->lines[l];
      if (open(k)[line.from] != open(k)[line.to]) {
        crossings_.push_back({static_cast<Index>(k), l, 0});
      }
    }
  }
  double step = 0.5;
  for (int round = 0; round < halvings; ++round, step /= 2) {
    segments_.clear();
    for (const Crossing& c : crossings_) {
      const Viewer& viewer = viewers_[c.viewer];
      segments_.push_back(
          {viewer.start, viewer.target(light_->at(light_->lines[c.line], c.s + step))});
    }
    trace();
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      Crossing& c = crossings_[i];
      const bool as_start = (blocked_[i] == 0) == (open(c.viewer)[light_->lines[c.line].from] != 0);
      if (as_start) c.s += step;
    }
  }
  for (const Crossing& c : crossings_) crossing_[c.viewer * n + c.line] = c.s + step;
}

/// In each triangle that the edge cuts, how far it bows out of the chord between the two cuts.
void ShadowSearch::search_bows(int halvings) {
  const std::size_t n = light_->triangles.size();
  bow_.assign(viewers_.size() * n, 0);
  bows_.clear();
  for (std::size_t k = 0; k < viewers_.size(); ++k) {
    for (const Index t : triangles_) {
      if (const int seen = seen_corners(k, light_->triangles[t]); seen == 1 || seen == 2) {
        bows_.push_back(chord_of(static_cast<Index>(k), t));
      }
    }
  }
  double step = kBowReach;
  for (int round = 0; round < halvings; ++round, step /= 2) {
    segments_.clear();
    for (const Bow& bow : bows_) {
      const Viewer& viewer = viewers_[bow.viewer];
      segments_.push_back({viewer.start, viewer.target(bow.middle + bow.outward * bow.s)});
    }
    trace();
    for (std::size_t i = 0; i < bows_.size(); ++i) {
      const bool as_tip = (blocked_[i] == 0) == bows_[i].odd_seen;
      bows_[i].s += as_tip ? step / 2 : -step / 2;
    }
  }
  for (const Bow& bow : bows_) {
    // A parabola over its chord has two thirds of the box around it.
    const double area = 2. / 3 * bow.s * length_squared(bow.outward);
    bow_[bow.viewer * n + bow.triangle] = area / light_->triangles[bow.triangle].area;
  }
}

int ShadowSearch::seen_corners(std::size_t k, const LatticeTriangle& triangle) const {
  const std::uint8_t* const seen = open(k);
  return seen[triangle.points[0]] + seen[triangle.points[1]] + seen[triangle.points[2]];
}

/// Where the edge cuts line k of the triangle, in parts of the line from its point `from`.
double ShadowSearch::cut(std::size_t k, const LatticeTriangle& triangle, std::size_t line,
                         Index from) const {
  const Index l = triangle.lines[line];
  const double s = crossing_[k * light_->lines.size() + l];
  return light_->lines[l].from == from ? s : 1 - s;
}

EdgeCut ShadowSearch::cut_of(std::size_t k, const LatticeTriangle& triangle) const {
  const auto seen = [&](std::size_t corner) { return open(k)[triangle.points[corner]] != 0; };
  const std::size_t odd = seen(0) == seen(1) ? 2 : seen(1) == seen(2) ? 0 : 1;
  const Index tip = triangle.points[odd];
  return {odd, cut(k, triangle, odd, tip), cut(k, triangle, (odd + 2) % 3, tip), seen(odd)};
}

ShadowSearch::Bow ShadowSearch::chord_of(Index k, Index t) const {
  const LatticeTriangle& triangle = light_->triangles[t];
  const EdgeCut cut = cut_of(k, triangle);
  const Vec3& tip = light_->points[triangle.points[cut.odd]];
  const Vec3 a = tip + (light_->points[triangle.points[(cut.odd + 1) % 3]] - tip) * cut.next;
  const Vec3 b = tip + (light_->points[triangle.points[(cut.odd + 2) % 3]] - tip) * cut.last;
  return {k, t, (a + b) * 0.5, cross(b - a, triangle.normal), 0, cut.odd_seen};
}

}  // namespace isolux
