#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "isolux/measure/measure.h"

namespace isolux {

/// Reads measuring points from CSV (RFC 4180, comma-separated): a header row that names at least
/// the columns x, y, z, nx, ny, nz (m; in any order, others are ignored), then a row for each
/// point. Normals are brought to length 1. Blank lines, spaces around values, quotes, a byte order
/// mark and either kind of line end are fine. `file` is the name that errors give. Throws
/// InputError with file, line and column (the field's, in characters) at the first row that lacks
/// a value, has one that is no finite number, or a normal of length zero; also where there is no
/// point.
std::vector<MeasurePoint> read_points(const std::string& text, const std::string& file);

/// The same from a file, at most 1 GiB long.
std::vector<MeasurePoint> load_points(const std::filesystem::path& path);

/// CSV with the columns x,y,z,nx,ny,nz (m) and Er,Eg,Eb,E (lx), nine significant digits,
/// and error (lx), three digits, empty where it is not known.
std::string measurements_to_csv(std::span<const Measurement> measurements);

}  // namespace isolux
