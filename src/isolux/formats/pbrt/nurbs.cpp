#include "isolux/formats/pbrt/nurbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "isolux/geometry/nurbs.h"
#include "isolux/scene/spelling.h"

namespace isolux::pbrt {
namespace {

/// A parameter that must be there.
const Parameter& require(const Parameters& parameters, const std::string& name,
                         const SourceLocation& where) {
  const Parameter* const p = parameters.find(name);
  if (!p) throw InputError(where, fmt::format("'nurbs' lacks {}", in_quotes(name)));
  return *p;
}

/// A whole number from 1 on.
std::size_t require_count(const Parameters& parameters, const std::string& name,
                          const SourceLocation& where) {
  const Parameter& p = require(parameters, name, where);
  const double number = *parameters.number(name);
  if (!(number >= 1 && number <= 1e6 && number == std::floor(number))) {
    p.fail(fmt::format("{} must be a whole number from 1 on", in_quotes(name)));
  }
  return static_cast<std::size_t>(number);
}

/// The degree, which is the order less one, and the knots along u or v.
KnotVector knot_vector(const Parameters& parameters, char axis, const SourceLocation& where) {
  return {require_count(parameters, fmt::format("{}order", axis), where) - 1,
          require(parameters, fmt::format("{}knots", axis), where).numbers};
}

/// Whether a surface ends before its knots do.
bool is_cut(const Parameters& parameters, const KnotVector& vector, char axis) {
  const auto& knots = vector.knots;
  if (knots.size() < 2 * vector.degree + 2) return false;
  const auto differs = [&](char end, double knot) {
    return parameters.number(fmt::format("{}{}", axis, end)).value_or(knot) != knot;
  };
  return differs('0', knots[vector.degree]) ||
         differs('1', knots[knots.size() - vector.degree - 1]);
}

}  // namespace

std::shared_ptr<const Shape> make_nurbs(const Parameters& parameters, const SourceLocation& where,
                                        Assembly& assembly) {
  const KnotVector u = knot_vector(parameters, 'u', where), v = knot_vector(parameters, 'v', where);
  if (std::max(u.degree, v.degree) > 3) return nullptr;
  if (is_cut(parameters, u, 'u') || is_cut(parameters, v, 'v')) {
    assembly.notes().add("NURBS that end before their knots do: made whole");
  }
  const std::size_t nu = require_count(parameters, "nu", where);
  const std::size_t nv = require_count(parameters, "nv", where);
  const bool weighted = parameters.find("Pw") != nullptr;
  const std::size_t stride = weighted ? 4 : 3;
  const Parameter& list = require(parameters, weighted ? "Pw" : "P", where);
  if (list.numbers.size() != nu * nv * stride) {
    list.fail(fmt::format("{} by {} points take {} numbers, not {}", nu, nv, nu * nv * stride,
                          list.numbers.size()));
  }
  Nurbs::Points points(nv);
  Nurbs::Weights weights(weighted ? nv : 0);
  for (std::size_t i = 0; i < nu * nv; ++i) {
    const double* const p = &list.numbers[i * stride];
    const double weight = weighted ? p[3] : 1;
    points[i / nu].push_back(Vec3{p[0], p[1], p[2]} / weight);  // those of Pw come times the weight
    if (weighted) weights[i / nu].push_back(weight);
  }
  return made_at(where, [&] {
    auto shape = std::make_shared<Nurbs>(u, v, std::move(points), std::move(weights));
    assembly.pieces().add(shape->part_count());
    return shape;
  });
}

}  // namespace isolux::pbrt
