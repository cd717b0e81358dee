#pragma once

#include <algorithm>
#include <vector>

#include "isolux/geometry/shape.h"

namespace isolux {

/// Where a line may cross the surface of a solid.
struct Candidate {
  double s;            ///< along the line, in a scale where the solid's size is about 1
  std::uint32_t face;  ///< which piece of the solid is met, in its own count
  double u = 0;        ///< the place on that piece, if it is a curved one
};

/// Appends the hits of a line that goes along `direction` with a bounded solid: those candidates
/// (in any order) at which it passes between outside and inside. `inside(s)` is asked halfway
/// between candidates, so that hits come in pairs whatever rounding does to each; false candidates
/// do no harm. Walls thinner than 1e-13 vanish. `hit(candidate)` makes the Hit; of candidates at
/// one place it is the one whose normal agrees with the crossing.
template <typename Inside, typename MakeHit>
void append_crossings(std::vector<Candidate>& candidates, const Vec3& direction,
                      const Inside& inside, const MakeHit& hit, Hits& hits) {
  constexpr double kSamePlace = 1e-13;
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.s < b.s; });
  bool was_inside = false;
  for (std::size_t i = 0, next = 0; i < candidates.size(); i = next) {
    for (next = i + 1; next < candidates.size(); ++next) {
      if (candidates[next].s - candidates[next - 1].s > kSamePlace) break;
    }
    const bool is_inside =
        next < candidates.size() && inside(0.5 * (candidates[next - 1].s + candidates[next].s));
    if (is_inside == was_inside) continue;
    Hit best = hit(candidates[i], is_inside);
    for (std::size_t k = i + 1; k < next && (dot(best.normal, direction) < 0) != is_inside; ++k) {
      const Hit other = hit(candidates[k], is_inside);
      if ((dot(other.normal, direction) < 0) == is_inside) best = other;
    }
    hits.push_back(best);
    was_inside = is_inside;
  }
}

}  // namespace isolux
