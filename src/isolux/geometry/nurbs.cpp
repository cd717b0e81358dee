#include "isolux/geometry/nurbs.h"

#include <fmt/format.h>

#include "isolux/core/error.h"
#include "isolux/geometry/shape_description.h"

namespace isolux {
namespace {

using Net = std::vector<std::vector<ControlPoint>>;

constexpr std::size_t kMostPatches = 1 << 16;
constexpr double kMostContrast = 1e6;  ///< of weights

template <typename Rows>
void require_grid(const Rows& rows, std::size_t row_count, std::size_t size,
                  std::string_view what) {
  if (rows.size() != row_count) {
    throw InputError(fmt::format("{}: must be {} rows, not {}", what, row_count, rows.size()));
  }
  for (std::size_t j = 0; j < row_count; ++j) {
    if (rows[j].size() == size) continue;
    throw InputError(
        fmt::format("{}: row number {} has {}, not {}", what, j + 1, rows[j].size(), size));
  }
}

void require_weights(const Nurbs::Weights& weights) {
  double least = weights[0][0], most = least;
  for (const auto& row : weights) {
    for (const double weight : row) {
      if (!(weight > 0 && std::isfinite(weight))) {
        throw InputError(fmt::format("weights: must be more than 0, not {}", weight));
      }
      least = std::min(least, weight), most = std::max(most, weight);
    }
  }
  if (most / least > kMostContrast) {
    throw InputError(fmt::format("weights: the largest may be {:g} times the least, not {:.3g}",
                                 kMostContrast, most / least));
  }
}

/// All rows of the net as Bézier arcs, which become the columns.
Net with_arcs(const Net& net, const KnotVector& vector) {
  Net columns(3 * arc_count(vector) + 1);
  for (const auto& row : net) {
    const auto arcs = cubic_arcs(vector, row);
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].push_back(arcs[i]);
  }
  return columns;
}

}  // namespace

Nurbs::Nurbs(KnotVector u, KnotVector v, Points points, Weights weights)
    : PatchSurface(patches(u, v, points, weights), "points", Degenerate::left_out),
      u_(std::move(u)),
      v_(std::move(v)),
      points_(std::move(points)),
      weights_(std::move(weights)) {}

std::vector<PatchSurface::ControlPoints> Nurbs::patches(const KnotVector& u, const KnotVector& v,
                                                        const Points& points,
                                                        const Weights& weights) {
  const std::size_t size = points.empty() ? 0 : points[0].size();
  require_grid(points, points.size(), size, "points");
  require_knots(u, size, "u_knots");
  require_knots(v, points.size(), "v_knots");
  if (!weights.empty()) {
    require_grid(weights, points.size(), size, "weights");
    require_weights(weights);
  }
  const std::size_t along_u = arc_count(u), along_v = arc_count(v);
  if (along_u * along_v > kMostPatches) {
    throw InputError(
        fmt::format("points: make {} by {} patches, more than {}", along_u, along_v, kMostPatches));
  }
  Net net(points.size());
  for (std::size_t j = 0; j < points.size(); ++j) {
    for (std::size_t i = 0; i < size; ++i) {
      net[j].push_back({points[j][i], weights.empty() ? 1 : weights[j][i] / weights[0][0]});
    }
  }
  net = with_arcs(with_arcs(net, u), v);
  std::vector<ControlPoints> all;
  for (std::size_t j = 0; j < along_v; ++j) {
    for (std::size_t i = 0; i < along_u; ++i) {
      ControlPoints& patch = all.emplace_back();
      for (std::size_t k = 0; k < 16; ++k) patch[k] = net[3 * j + k / 4][3 * i + k % 4];
    }
  }
  return all;
}

ShapeDescription Nurbs::describe() const {
  const std::vector<double> degrees = {static_cast<double>(u_.degree),
                                       static_cast<double>(v_.degree)};
  ShapeDescription shape{
      "nurbs",
      {{"degrees", degrees}, {"u_knots", u_.knots}, {"v_knots", v_.knots}, {"points", points_}},
      {},
      {}};
  if (!weights_.empty()) shape.fields.push_back({"weights", weights_});
  return shape;
}

}  // namespace isolux
