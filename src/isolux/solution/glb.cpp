#include "isolux/solution/glb.h"

#include <fmt/format.h>

#include <limits>

#include "isolux/core/error.h"
#include "isolux/core/json_limits.h"

namespace isolux {
namespace {

using nlohmann::json;

constexpr std::uint32_t kMagic = 0x46546c67;   // "glTF"
constexpr std::uint32_t kJson = 0x4e4f534a;    // "JSON"
constexpr std::uint32_t kBinary = 0x004e4942;  // "BIN\0"
constexpr std::uint64_t kMaxBytes = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
// A solution's JSON is shallow, and nearly all of it is the one string of the scene's text.
constexpr int kMaxDepth = 16;
constexpr int kMaxValues = 1'000'000;

void append_word(std::string& bytes, std::uint64_t word) {
  const auto w = static_cast<std::uint32_t>(word);
  bytes.append(reinterpret_cast<const char*>(&w), sizeof w);
}

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t w = 0;
  std::memcpy(&w, bytes.data() + offset, sizeof w);
  return w;
}

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

/// The chunk at `offset`, which is moved past it.
std::string_view take_chunk(const std::string& bytes, std::size_t& offset, std::uint32_t type) {
  if (bytes.size() - offset < kChunkHeaderBytes) throw InputError("is damaged: a chunk is missing");
  const std::uint32_t size = word_at(bytes, offset);
  if (word_at(bytes, offset + 4) != type) throw InputError("is damaged: a chunk has a wrong type");
  offset += kChunkHeaderBytes;
  if (size > bytes.size() - offset) throw InputError("is damaged: a chunk leaves the file");
  const std::string_view chunk(bytes.data() + offset, size);
  offset += size;
  return chunk;
}

json parse(std::string_view text) {
  if (!within_json_limits(text, kMaxDepth, kMaxValues)) {
    throw InputError("is not a solution of isolux: its JSON is far too large");
  }
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::parse_error& error) {
    throw InputError(fmt::format("is damaged: its JSON is malformed at byte {}", error.byte));
  } catch (const json::exception&) {
    throw InputError("is damaged: its JSON holds a number out of range");
  }
}

}  // namespace

std::string encode_glb(const Glb& glb) {
  std::string text;
  try {
    text = glb.json.dump();
  } catch (const json::exception&) {
    throw InputError("can't be written: the scene's text is not UTF-8");
  }
  text.resize(padded(text.size()), ' ');
  const std::size_t binary_size = padded(glb.binary.size());
  const std::size_t size = kHeaderBytes + 2 * kChunkHeaderBytes + text.size() + binary_size;
  if (size > kMaxBytes) throw InputError("can't be written: a GLB holds at most 4 GiB");

  std::string bytes;
  bytes.reserve(size);
  append_word(bytes, kMagic), append_word(bytes, 2), append_word(bytes, size);
  append_word(bytes, text.size()), append_word(bytes, kJson);
  bytes += text;
  append_word(bytes, binary_size), append_word(bytes, kBinary);
  bytes += glb.binary;
  bytes.resize(size, '\0');
  return bytes;
}

Glb decode_glb(const std::string& bytes) {
  if (bytes.size() < 4 || word_at(bytes, 0) != kMagic) {
    throw InputError("is not a solution of isolux: it is no GLB");
  }
  if (bytes.size() < kHeaderBytes) throw InputError("is truncated: its header is not complete");
  if (word_at(bytes, 4) != 2) throw InputError("is not a solution of isolux: not GLB version 2");
  const std::uint32_t size = word_at(bytes, 8);
  if (size > bytes.size()) {
    throw InputError(fmt::format("is truncated: it should have {} bytes and has {}; solve again",
                                 size, bytes.size()));
  }
  if (size < bytes.size()) {
    throw InputError(fmt::format("is damaged: {} bytes follow its end", bytes.size() - size));
  }
  std::size_t offset = kHeaderBytes;
  Glb glb;
  glb.json = parse(take_chunk(bytes, offset, kJson));
  if (offset < bytes.size()) glb.binary = take_chunk(bytes, offset, kBinary);
  if (offset < bytes.size()) throw InputError("is not a solution of isolux: it has extra chunks");
  return glb;
}

const char* element_type(int components) {
  return components == 1 ? "SCALAR" : components == 3 ? "VEC3" : "VEC4";
}

int add_accessor(Glb& glb, std::span<const char> bytes, int component, int components,
                 std::size_t count, BufferTarget target) {
  json& views = glb.json["bufferViews"];
  json& accessors = glb.json["accessors"];
  json view = {{"buffer", 0}, {"byteOffset", glb.binary.size()}, {"byteLength", bytes.size()}};
  if (target != BufferTarget::none) view["target"] = static_cast<int>(target);
  glb.binary.append(bytes.data(), bytes.size());
  glb.binary.resize(padded(glb.binary.size()), '\0');
  accessors.push_back({{"bufferView", views.size()},
                       {"componentType", component},
                       {"type", element_type(components)},
                       {"count", count}});
  views.push_back(std::move(view));
  return static_cast<int>(accessors.size()) - 1;
}

const json& member(const json& object, const char* key) {
  if (object.is_object()) {
    const auto found = object.find(key);
    if (found != object.end()) return *found;
  }
  throw InputError(fmt::format("is not a solution of isolux: its JSON lacks '{}'", key));
}

std::uint64_t integer_member(const json& object, const char* key, std::uint64_t max) {
  const json& value = member(object, key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > max) {
    throw InputError(fmt::format("is damaged: '{}' is not an integer from 0 to {}", key, max));
  }
  return value.get<std::uint64_t>();
}

namespace {

const json& element(const Glb& glb, const char* list, std::uint64_t index) {
  const json& elements = member(glb.json, list);
  if (!elements.is_array() || index >= elements.size()) {
    throw InputError(fmt::format("is damaged: it has no entry {} in '{}'", index, list));
  }
  return elements[index];
}

std::uint64_t integer_or_zero(const json& object, const char* key) {
  return object.contains(key) ? integer_member(object, key, kMaxBytes) : 0;
}

}  // namespace

std::size_t accessor_count(const Glb& glb, std::uint64_t index) {
  return integer_member(element(glb, "accessors", index), "count", kMaxBytes);
}

std::span<const char> accessor_bytes(const Glb& glb, std::uint64_t index, int component,
                                     int components, std::size_t count, std::size_t element_size) {
  const json& accessor = element(glb, "accessors", index);
  if (member(accessor, "componentType") != component ||
      member(accessor, "type") != element_type(components) || accessor.contains("sparse")) {
    throw InputError(
        fmt::format("is not a solution of isolux: accessor {} has the wrong type", index));
  }
  if (accessor_count(glb, index) != count) {
    throw InputError(fmt::format("is damaged: accessor {} should have {} elements", index, count));
  }
  const json& view = element(glb, "bufferViews", integer_member(accessor, "bufferView", kMaxBytes));
  const std::uint64_t stride = integer_or_zero(view, "byteStride");
  if (integer_member(view, "buffer", kMaxBytes) != 0 || (stride != 0 && stride != element_size)) {
    throw InputError("is not a solution of isolux: another program has rearranged it");
  }
  const std::uint64_t view_begin = integer_or_zero(view, "byteOffset");
  const std::uint64_t view_size = integer_member(view, "byteLength", kMaxBytes);
  const std::uint64_t begin = integer_or_zero(accessor, "byteOffset");
  const std::uint64_t size = std::uint64_t{count} * element_size;  // < 2^32 × 16: no overflow
  if (view_begin + view_size > glb.binary.size() || begin + size > view_size) {
    throw InputError(fmt::format("is damaged: accessor {} leaves the binary chunk", index));
  }
  return std::span<const char>(glb.binary).subspan(view_begin + begin, size);
}

}  // namespace isolux
