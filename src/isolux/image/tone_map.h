#pragma once

#include "isolux/image/picture.h"

namespace isolux {

/// From luminances (cd/m²) to linear display values in [0, 1], by one curve for the whole picture,
/// which keeps the order of luminances and the hue.
///
/// After Reinhard et al. 2002, "Photographic tone reproduction for digital images", eq. 4:
///   L_d = L (1 + L / L_w²) / (1 + L),   L = 0.35 × luminance / key.
/// The key is the log-average of the lit pixels, the brightest 2 % left out; L_w, the least that
/// is shown white, is 1.2 × the luminance that 2 % of the lit pixels exceed, and at least 1: lamps
/// saturate, walls do not. A picture without light stays black, as do pixels that are not finite.
Picture tone_map(const Picture& luminance);

}  // namespace isolux
