#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace isolux {

static_assert(std::endian::native == std::endian::little, "GLB is little-endian");

/// The two chunks of a GLB, version 2 (Khronos, glTF 2.0 Specification, §4.4). Solutions are read
/// by these few functions, not by a general glTF library, because such a library opens other files
/// that the JSON names, and copies the binary chunk as often as the JSON asks for it.
struct Glb {
  nlohmann::json json;
  std::string binary;
};

/// Throws InputError (without a location) where the chunks don't fit into 4 GiB, or text in the
/// JSON is not UTF-8.
std::string encode_glb(const Glb& glb);

/// Throws InputError (without a location) where `bytes` is not a GLB, is truncated or goes on after
/// its end, or its JSON is malformed or absurdly large.
Glb decode_glb(const std::string& bytes);

/// glTF's number of a component type (§3.6.2.2).
template <typename Number>
constexpr int component_type() {
  if constexpr (std::is_same_v<Number, std::uint8_t>) return 5121;
  if constexpr (std::is_same_v<Number, std::uint16_t>) return 5123;
  if constexpr (std::is_same_v<Number, std::uint32_t>) return 5125;
  if constexpr (std::is_same_v<Number, float>) return 5126;
}

/// What an array is bound to (§5.11.5); zero for none.
enum class BufferTarget { none = 0, vertices = 34962, indices = 34963 };

/// glTF's name of an element of 1, 3 or 4 components, "SCALAR", "VEC3" or "VEC4".
const char* element_type(int components);

/// Appends `bytes` to the binary chunk and describes them by a bufferView of their own and an
/// accessor, whose index it returns.
int add_accessor(Glb& glb, std::span<const char> bytes, int component, int components,
                 std::size_t count, BufferTarget target);

/// The bytes of accessor `index`: a view into `glb`. Throws InputError where the accessor is not
/// one of ours (component type, components, `count` elements, packed) or leaves the binary chunk.
std::span<const char> accessor_bytes(const Glb& glb, std::uint64_t index, int component,
                                     int components, std::size_t count, std::size_t element_size);

/// The number of elements that accessor `index` claims to have; not yet checked against the bytes.
std::size_t accessor_count(const Glb& glb, std::uint64_t index);

template <typename Number>
int add_array(Glb& glb, std::span<const Number> numbers, int components,
              BufferTarget target = BufferTarget::none) {
  const std::span<const char> bytes(reinterpret_cast<const char*>(numbers.data()),
                                    numbers.size_bytes());
  return add_accessor(glb, bytes, component_type<Number>(), components,
                      numbers.size() / static_cast<std::size_t>(components), target);
}

template <typename Number>
std::vector<Number> read_array(const Glb& glb, std::uint64_t index, int components,
                               std::size_t count) {
  const std::size_t element_size = sizeof(Number) * static_cast<std::size_t>(components);
  const std::span<const char> bytes =
      accessor_bytes(glb, index, component_type<Number>(), components, count, element_size);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

/// Member `key` of an object; throws InputError where there is none.
const nlohmann::json& member(const nlohmann::json& object, const char* key);

/// Member `key` of an object as an integer from 0 to `max`; throws InputError where it is not one.
std::uint64_t integer_member(const nlohmann::json& object, const char* key, std::uint64_t max);

}  // namespace isolux
