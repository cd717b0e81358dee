#pragma once

namespace isolux {

/// A point of the square [−1, 1]² or of the unit disk.
struct Point2 {
  double x, y;
};

/// The square's point on the disk: rings of the square become rings of the disk, areas keep their
/// ratios (Shirley & Chiu 1997).
Point2 square_to_disk(const Point2& p);

/// The way back. Distances grow by a factor of kMostStretch at most.
Point2 disk_to_square(const Point2& p);
inline constexpr double kMostStretch = 1.76;

}  // namespace isolux
