#include "isolux/geometry/b_spline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "isolux/core/error.h"

namespace isolux {
namespace {

using Arc = std::array<ControlPoint, 4>;

/// Calls visit(i) for each arc, which runs from knot i to the next.
template <typename Visit>
void for_arcs(const KnotVector& vector, const Visit& visit) {
  const auto& [degree, knots] = vector;
  for (std::size_t i = degree; i + degree + 1 < knots.size(); ++i) {
    if (knots[i] < knots[i + 1]) visit(i);
  }
}

/// Control point `number` of the arc from knot `first` to the next: the blossom at the arc's start,
/// degree − number times, and at its end, `number` times. Each step stays between two points, since
/// the arc lies between the knots whose distance it divides by.
ControlPoint arc_point(const KnotVector& vector, const std::vector<ControlPoint>& points,
                       std::size_t first, std::size_t number) {
  const auto& [degree, knots] = vector;
  Arc p;
  std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(first - degree), degree + 1, p.begin());
  for (std::size_t step = 0; step < degree; ++step) {
    const double at = knots[step < number ? first + 1 : first];
    for (std::size_t i = 0; i < degree - step; ++i) {
      const double from = knots[first - degree + step + i + 1], to = knots[first + i + 1];
      p[i] = between(p[i], p[i + 1], (at - from) / (to - from));
    }
  }
  return p[0];
}

/// Of degree + 1 points four for the same curve.
void raise_to_cubic(Arc& arc, std::size_t degree) {
  for (; degree < 3; ++degree) {
    arc[degree + 1] = arc[degree];
    for (std::size_t i = degree; i > 0; --i) {
      arc[i] =
          between(arc[i], arc[i - 1], static_cast<double>(i) / static_cast<double>(degree + 1));
    }
  }
}

}  // namespace

void require_knots(const KnotVector& vector, std::size_t points, std::string_view what) {
  constexpr double kLargest = 1e12;
  const auto& [degree, knots] = vector;
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("{}: {}", what, why));
  };
  if (degree < 1 || degree > 3) refuse(fmt::format("the degree must be 1 to 3, not {}", degree));
  if (points <= degree) {
    refuse(
        fmt::format("a degree of {} takes {} points at least, not {}", degree, degree + 1, points));
  }
  if (knots.size() != points + degree + 1) {
    refuse(fmt::format("{} points of degree {} take {} knots, not {}", points, degree,
                       points + degree + 1, knots.size()));
  }
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!(std::abs(knots[i]) <= kLargest)) {
      refuse(fmt::format("must be finite numbers between -{0:g} and {0:g}, not {1}", kLargest,
                         knots[i]));
    }
    if (i > 0 && knots[i] < knots[i - 1]) {
      refuse(fmt::format("must not fall, as {} does after {}", knots[i], knots[i - 1]));
    }
  }
  const double from = knots[degree], to = knots[points];
  if (!(from < to)) {
    refuse(fmt::format("the curve runs from knot {} to knot {}, which are both {}", degree + 1,
                       points + 1, from));
  }
  for (auto i = knots.begin(); i != knots.end();) {
    const auto next = std::upper_bound(i, knots.end(), *i);
    const auto times = static_cast<std::size_t>(next - i);
    const std::size_t most = *i > from && *i < to ? degree : degree + 1;
    if (times > most) {
      refuse(fmt::format("{} is there {} times, where a degree of {} allows {}", *i, times, degree,
                         most));
    }
    i = next;
  }
}

std::size_t arc_count(const KnotVector& vector) {
  std::size_t count = 0;
  for_arcs(vector, [&](std::size_t) { ++count; });
  return count;
}

std::vector<ControlPoint> cubic_arcs(const KnotVector& vector,
                                     const std::vector<ControlPoint>& points) {
  std::vector<ControlPoint> arcs;
  for_arcs(vector, [&](std::size_t first) {
    Arc arc;
    for (std::size_t i = 0; i <= vector.degree; ++i) {
      arc[i] = arc_point(vector, points, first, i);
    }
    raise_to_cubic(arc, vector.degree);
    arcs.insert(arcs.end(), arc.begin() + (arcs.empty() ? 0 : 1), arc.end());
  });
  return arcs;
}

}  // namespace isolux
