#include "isolux/formats/openscad/arguments.h"

#include <fmt/format.h>

#include "isolux/scene/spelling.h"

namespace isolux::openscad {
namespace {

constexpr double kLargest = 1e9;

}  // namespace

/// The argument of that name; null where it is not there or undef.
const Literal* Arguments::given(std::string_view name) const {
  const Literal* const value = node_.find(name);
  return value && !std::holds_alternative<std::monostate>(value->content) ? value : nullptr;
}

const Literal& Arguments::required(std::string_view name) const {
  if (const Literal* const value = given(name)) return *value;
  tree_.fail(node_.place, fmt::format("{} needs {}: export the model with OpenSCAD again",
                                      in_quotes(node_.name), in_quotes(name)));
}

double Arguments::number(const Literal& value, std::string_view what) const {
  const double* const number = value.number();
  if (!number) tree_.fail(value.place, fmt::format("{} must be a number", in_quotes(what)));
  if (std::abs(*number) > kLargest) {
    tree_.fail(value.place,
               fmt::format("{} must be within {:g}, not {:g}", in_quotes(what), kLargest, *number));
  }
  return *number;
}

const Literal::List& Arguments::list(const Literal& value, std::string_view what,
                                     std::size_t least) const {
  const Literal::List* const list = value.list();
  if (!list || list->size() < least) {
    tree_.fail(value.place, fmt::format("{} must be a list of {} or more", in_quotes(what), least));
  }
  return *list;
}

double Arguments::number(std::string_view name) const { return number(required(name), name); }

double Arguments::number(std::string_view name, double otherwise) const {
  const Literal* const value = given(name);
  return value ? number(*value, name) : otherwise;
}

bool Arguments::flag(std::string_view name) const {
  const Literal* const value = given(name);
  if (!value) return false;
  const bool* const flag = std::get_if<bool>(&value->content);
  if (!flag) tree_.fail(value->place, fmt::format("{} must be true or false", in_quotes(name)));
  return *flag;
}

std::vector<double> Arguments::numbers(std::string_view name, std::size_t count) const {
  const Literal& value = required(name);
  if (value.number()) return std::vector(count, number(value, name));
  std::vector<double> numbers;
  for (const Literal& item : list(value, name, count)) numbers.push_back(number(item, name));
  numbers.resize(count);
  return numbers;
}

std::vector<Vec3> Arguments::points(std::string_view name, std::size_t dimension) const {
  std::vector<Vec3> points;
  for (const Literal& item : list(required(name), name, 0)) {
    const Literal::List& coordinates = list(item, name, dimension);
    Vec3& point = points.emplace_back();
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      point[static_cast<int>(axis)] = number(coordinates[axis], name);
    }
  }
  return points;
}

std::vector<std::vector<std::uint32_t>> Arguments::places(std::string_view name,
                                                          std::size_t size) const {
  std::vector<std::vector<std::uint32_t>> places;
  const Literal* const value = given(name);
  if (!value) return places;
  for (const Literal& item : list(*value, name, 0)) {
    auto& row = places.emplace_back();
    for (const Literal& place : list(item, name, 0)) {
      const double index = number(place, name);
      if (!(index >= 0 && index < static_cast<double>(size)) || index != std::floor(index)) {
        tree_.fail(place.place, fmt::format("there is no point {:g}: they count from 0 to {}",
                                            index, static_cast<long long>(size) - 1));
      }
      row.push_back(static_cast<std::uint32_t>(index));
    }
  }
  return places;
}

Affine Arguments::matrix() const {
  const auto fail = [&](const Place& place) {
    tree_.fail(place, "'multmatrix' needs a matrix of four rows of four, the last 0, 0, 0, 1");
  };
  if (node_.arguments.empty()) fail(node_.place);
  const Literal& value = node_.arguments.front().value;
  const Literal::List* const rows = value.list();
  if (!rows || rows->size() < 3 || rows->size() > 4) fail(value.place);
  Affine map;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const Literal& row = (*rows)[i];
    const Literal::List* const items = row.list();
    if (!items || items->size() != 4) fail(row.place);
    std::array<double, 4> m;
    for (std::size_t k = 0; k < 4; ++k) m[k] = number((*items)[k], "multmatrix");
    if (i < 3) {
      map.linear[i] = {m[0], m[1], m[2]};
      map.translation[static_cast<int>(i)] = m[3];
    } else if (m != std::array<double, 4>{0, 0, 0, 1}) {
      fail(row.place);
    }
  }
  return map;
}

std::array<double, 4> Arguments::color() const {
  if (node_.arguments.empty()) tree_.fail(node_.place, "'color' needs a color");
  const Literal& value = node_.arguments.front().value;
  const Literal::List& channels = list(value, "color", 3);
  std::array<double, 4> color = {0, 0, 0, 1};
  for (std::size_t i = 0; i < std::min<std::size_t>(4, channels.size()); ++i) {
    color[i] = number(channels[i], "color");
    if (color[i] >= 0 && color[i] <= 1) continue;
    // OpenSCAD writes -1 for "none".
    if (color[i] == -1) return {-1, -1, -1, 1};
    tree_.fail(channels[i].place, "channels of a 'color' must be from 0 to 1");
  }
  return color;
}

}  // namespace isolux::openscad
