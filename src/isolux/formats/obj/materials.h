#pragma once

#include <map>
#include <string>

#include "isolux/formats/assembly.h"
#include "isolux/formats/include_path.h"
#include "isolux/formats/texture.h"

namespace isolux::obj {

using Materials = std::map<std::string, Look, std::less<>>;

/// Adds the materials of an MTL file to `materials`, by their names; those that are there already
/// stay. The file is the innermost of `includes`: its textures are found beside it.
void read_materials(const SourceText& source, Includes& includes, Textures& textures,
                    Materials& materials, Notes& notes);

}  // namespace isolux::obj
