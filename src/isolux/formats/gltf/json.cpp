#include "isolux/formats/gltf/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "isolux/core/error.h"
#include "isolux/core/json_limits.h"

namespace isolux::gltf {

using nlohmann::json;

void Json::fail(const std::string& message) const {
  throw InputError({*file_}, path_.empty() ? message : path_ + ": " + message);
}

std::optional<Json> Json::find(const char* key) const {
  if (!value_->is_object()) fail("must be an object");
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return Json(*file_, *found, path_.empty() ? key : path_ + '.' + key);
}

Json Json::require(const char* key) const {
  const auto found = find(key);
  if (!found) fail(fmt::format("lacks '{}'", key));
  return *found;
}

std::size_t Json::size() const {
  if (!value_->is_array()) fail("must be a list");
  return value_->size();
}

Json Json::item(std::size_t i) const {
  return {*file_, value_->at(i), fmt::format("{}[{}]", path_, i)};
}

double Json::number() const {
  if (!value_->is_number()) fail("must be a number");
  return value_->get<double>();
}

std::vector<double> Json::numbers(std::size_t count) const {
  if (size() != count) fail(fmt::format("must be a list of {} numbers", count));
  std::vector<double> list;
  for (std::size_t i = 0; i < count; ++i) list.push_back(item(i).number());
  return list;
}

Vec3 Json::vector() const {
  const std::vector<double> v = numbers(3);
  return {v[0], v[1], v[2]};
}

std::uint64_t Json::integer(std::uint64_t most) const {
  const double value = number();
  if (!(value >= 0 && value <= static_cast<double>(most)) || value != std::floor(value)) {
    fail(fmt::format("must be a whole number from 0 to {}", most));
  }
  return static_cast<std::uint64_t>(value);
}

const std::string& Json::text() const {
  if (!value_->is_string()) fail("must be a text");
  return value_->get_ref<const std::string&>();
}

double Json::number(const char* key, double otherwise) const {
  const auto found = find(key);
  return found ? found->number() : otherwise;
}

std::uint64_t Json::integer(const char* key, std::uint64_t most, std::uint64_t otherwise) const {
  const auto found = find(key);
  return found ? found->integer(most) : otherwise;
}

std::string Json::text(const char* key) const {
  const auto found = find(key);
  return found ? found->text() : std::string();
}

bool Json::flag(const char* key) const {
  const auto found = find(key);
  if (found && !found->value_->is_boolean()) found->fail("must be true or false");
  return found && found->value_->get<bool>();
}

std::optional<Json> Json::extension(const char* name) const {
  const auto extensions = find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

json parse_json(std::string_view text, const std::string& file) {
  if (!within_json_limits(text, 64, 2'000'000)) {
    throw InputError({file}, "the JSON is too deep or has too many values");
  }
  try {
    json tree = json::parse(text.begin(), text.end());
    if (!tree.is_object()) throw InputError({file, 1, 1}, "the JSON must be an object");
    return tree;
  } catch (const json::parse_error& error) {
    const std::string_view before = text.substr(0, std::max<std::size_t>(error.byte, 1) - 1);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t start = before.rfind('\n') + 1;  // 0 where there is none
    throw InputError({file, static_cast<int>(line), static_cast<int>(before.size() - start) + 1},
                     "the JSON is malformed here");
  } catch (const json::exception&) {
    throw InputError({file}, "the JSON holds a number out of range");
  }
}

}  // namespace isolux::gltf
