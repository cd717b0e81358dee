#pragma once

#include "isolux/scene/sky.h"
#include "isolux/scene/value.h"

namespace isolux {

/// Reads a `sky`: nowhere negative, at most 1e9 cd/m² everywhere.
Sky read_sky(const Value& sky);

}  // namespace isolux
