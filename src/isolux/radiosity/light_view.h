#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/radiosity/shadow_search.h"

namespace isolux {

/// What a group of receivers sees of one light after another; kept for its memory.
class LightView {
 public:
  /// `rays` must outlive it.
  LightView(const RayCaster& rays, const Precision& precision)
      : rays_(rays), precision_(precision), search_(rays) {}

  /// Adds the light to each receiver's irradiance (lx), and to the variance of its luminance (lx²).
  /// Where nothing stands between, the light counts by the closed form.
  void light_up(const LightLattice& light, std::span<const Receiver> receivers,
                std::span<Rgb> irradiance, std::span<double> variance);

 private:
  /// A form factor on its way: of what is seen, its variance, and the σ that its cuts share, since
  /// where an edge runs along the lattice all are off by the same.
  struct Sum {
    double factor = 0, variance = 0, shift = 0;
  };
  /// What is seen of a piece by the weights of its lattice triangles.
  struct Weights {
    double whole = 0, seen = 0, spread = 0, shared = 0;
  };

  bool find_viewers(std::span<const Receiver> receivers);
  bool may_see(const Piece& piece, const Receiver& receiver) const;
  Blockers blockers() const;
  void add_piece(const Piece& piece, std::size_t k, Sum& sum) const;
  void add_ball(std::size_t k, Sum& sum) const;
  void add_cut(const EdgeCut& cut, double bow, double weight, double seen, Weights& weights) const;
  double exact(const LatticeTriangle& triangle, const Receiver& receiver) const;
  double exact_part(const LatticeTriangle& triangle, const EdgeCut& cut,
                    const Receiver& receiver) const;
  double pencil(const LatticeTriangle& triangle, const Receiver& receiver) const;
  Vec3 middle(const LatticeTriangle& triangle) const;

  const RayCaster& rays_;
  const Precision precision_;
  const LightLattice* light_ = nullptr;
  std::vector<Viewer> viewers_;   // those that may see the light
  std::vector<std::size_t> who_;  // each is among the receivers
  ShadowSearch search_;
  ShadowSearch::Seen seen_ = ShadowSearch::Seen::all;
};

}  // namespace isolux
