#pragma once

#include "isolux/formats/soup.h"
#include "isolux/formats/statement.h"

namespace isolux {

namespace obj {

/// The vertices of a file, as its lines "v x y z" give them.
class Vertices {
 public:
  void read(const Statement& line);
  /// The vertex that word `i` of a face names: its number, counted from 1, or back from the last
  /// one where it is negative; what stands behind a slash is of no interest.
  std::uint32_t corner(const Statement& face, std::size_t i) const;
  const std::vector<Vec3>& points() const { return points_; }

 private:
  std::vector<Vec3> points_;
};

}  // namespace obj

/// The polygons of an OBJ file, whatever object and material they belong to. Throws InputError
/// with line and column.
TriangleSoup parse_obj(const SourceText& source, Cutting& cutting);

}  // namespace isolux
