#pragma once

#include <Eigen/Dense>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/discretization/triangulation.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// Form factors between the living triangles of a mesh, each the mean over the corners of the
/// receiving one: entry (i, j) is the part of the light around triangle i that comes from j. Rows
/// and columns follow the triangles' order. Meant for small meshes: memory and time are quadratic.
Eigen::MatrixXd form_factor_matrix(const Triangulation& mesh, const RayCaster& rays,
                                   int subdivisions);

/// Full-matrix radiosity (§1.1.1, after Goral et al. 1984): solves (I − ρF) B = E by Gauss–Seidel
/// until no radiosity changes by more than `tolerance` × the largest. Returns B of the living
/// triangles, in their order, lm/m². A triangle's ρ is the mean of its corners'.
std::vector<Rgb> full_matrix_radiosity(const Triangulation& mesh, const Eigen::MatrixXd& factors,
                                       double tolerance);

}  // namespace isolux
