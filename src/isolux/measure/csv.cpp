#include "isolux/measure/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string_view>

#include "isolux/core/error.h"
#include "isolux/core/file.h"

namespace isolux {
namespace {

constexpr std::array<const char*, 6> kColumns = {"x", "y", "z", "nx", "ny", "nz"};
constexpr std::size_t kMissing = static_cast<std::size_t>(-1);
constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

struct Field {
  std::string text;  // without quotes and the spaces around
  int column = 0;
};

std::string trimmed(std::string_view text) {
  constexpr const char* kSpace = " \t";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(kSpace) - begin + 1));
}

/// Cuts one line at its commas. A quoted field holds commas and doubled quotes, not line ends:
/// no point has any.
void split(std::string_view line, const SourceLocation& where, std::vector<Field>& fields) {
  fields.clear();
  std::size_t i = 0;
  while (true) {
    Field field;
    while (i < line.size() && (line[i] == ' ' || line[i] == '\t')) ++i;
    field.column = static_cast<int>(i) + 1;
    if (i < line.size() && line[i] == '"') {
      for (++i;; ++i) {
        if (i >= line.size()) {
          throw InputError({where.file, where.line, field.column}, "a quote is never closed");
        }
        if (line[i] == '"' && (++i >= line.size() || line[i] != '"')) break;
        field.text += line[i];
      }
      field.text = trimmed(field.text);
    }
    const std::size_t comma = std::min(line.find(',', i), line.size());
    const std::string rest = trimmed(line.substr(i, comma - i));
    if (!field.text.empty() && !rest.empty()) {
      throw InputError({where.file, where.line, static_cast<int>(i) + 1},
                       "text follows a closing quote; put a comma between them");
    }
    if (!rest.empty()) field.text = rest;
    fields.push_back(std::move(field));
    if (comma == line.size()) return;
    i = comma + 1;
  }
}

std::array<std::size_t, 6> find_columns(const std::vector<Field>& header,
                                        const SourceLocation& where) {
  std::array<std::size_t, 6> columns;
  columns.fill(kMissing);
  for (std::size_t i = 0; i < header.size(); ++i) {
    const auto known = std::find(kColumns.begin(), kColumns.end(), header[i].text);
    if (known == kColumns.end()) continue;
    std::size_t& column = columns[static_cast<std::size_t>(known - kColumns.begin())];
    if (column != kMissing) {
      throw InputError({where.file, where.line, header[i].column},
                       fmt::format("column '{}' is there twice; remove one", *known));
    }
    column = i;
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k] != kMissing) continue;
    throw InputError(
        where, fmt::format("the header lacks column '{}'; it needs x,y,z,nx,ny,nz", kColumns[k]));
  }
  return columns;
}

double number(const Field& field, const char* name, SourceLocation where) {
  where.column = field.column;
  const char* begin = field.text.data();
  const char* end = begin + field.text.size();
  if (begin != end && *begin == '+' && end - begin > 1 && begin[1] != '-') ++begin;
  double value = 0;
  const auto [rest, failure] = std::from_chars(begin, end, value);
  if (failure != std::errc{} || rest != end || !std::isfinite(value)) {
    throw InputError(where, fmt::format("'{}' must be a finite number, not '{}'", name,
                                        field.text.substr(0, 40)));
  }
  return value;
}

MeasurePoint point_of(const std::vector<Field>& fields, const std::array<std::size_t, 6>& columns,
                      const SourceLocation& where) {
  std::array<double, 6> v;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k] >= fields.size()) {
      throw InputError(where, fmt::format("the row has {} values and none for column '{}'",
                                          fields.size(), kColumns[k]));
    }
    v[k] = number(fields[columns[k]], kColumns[k], where);
  }
  // Scaled first, so that no square overflows or vanishes.
  const double largest = std::max({std::abs(v[3]), std::abs(v[4]), std::abs(v[5])});
  if (largest == 0) {
    throw InputError({where.file, where.line, fields[columns[3]].column},
                     "the normal (nx, ny, nz) must not be zero");
  }
  return {{v[0], v[1], v[2]}, normalized(Vec3{v[3] / largest, v[4] / largest, v[5] / largest})};
}

}  // namespace

std::vector<MeasurePoint> read_points(const std::string& text, const std::string& file) {
  std::string_view rest = text;
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  SourceLocation where{file, 0, 1};
  std::vector<Field> fields;
  std::array<std::size_t, 6> columns{};
  bool header_read = false;
  std::vector<MeasurePoint> points;
  while (!rest.empty()) {
    ++where.line;
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
    split(line, where, fields);
    if (header_read) {
      points.push_back(point_of(fields, columns, where));
    } else {
      columns = find_columns(fields, where);
      header_read = true;
    }
  }
  if (points.empty()) {
    throw InputError({file}, "has no points; give a header x,y,z,nx,ny,nz and a row for each");
  }
  return points;
}

std::vector<MeasurePoint> load_points(const std::filesystem::path& path) {
  return read_points(read_file(path, kMaxBytes), path.string());
}

std::string measurements_to_csv(std::span<const Measurement> measurements) {
  std::string csv = "x,y,z,nx,ny,nz,Er,Eg,Eb,E,error\n";
  for (const Measurement& m : measurements) {
    const auto& [p, n] = m.at;
    const Rgb& e = m.irradiance;
    fmt::format_to(std::back_inserter(csv),
                   "{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{}\n",
                   p.x, p.y, p.z, n.x, n.y, n.z, e.r, e.g, e.b, m.illuminance(),
                   m.error ? fmt::format("{:.3g}", *m.error) : "");
  }
  return csv;
}

}  // namespace isolux
