#pragma once

#include "isolux/radiosity/full_matrix.h"

namespace isolux {

/// Plain progressive radiosity (§1.1.2, after Cohen et al. 1988) on a mesh that stays as it is: the
/// element with the most unshot power shoots, until the unshot power is below `stop_at_unshot` ×
/// the emitted. Returns B as full_matrix_radiosity() does.
std::vector<Rgb> plain_progressive_radiosity(const Triangulation& mesh,
                                             const Eigen::MatrixXd& factors, double stop_at_unshot);

}  // namespace isolux
