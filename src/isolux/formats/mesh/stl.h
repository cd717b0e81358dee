#pragma once

#include <string>
#include <vector>

#include "isolux/formats/include_path.h"
#include "isolux/geometry/shape.h"

namespace isolux {

/// A solid of an STL file.
struct StlSolid {
  std::string name;
  TriangleSoup soup;
};

/// The solids of an STL file, as text or binary (which has one). Normals are left aside. Throws
/// InputError, with line and column in a text.
std::vector<StlSolid> parse_stl(const SourceText& source);

}  // namespace isolux
