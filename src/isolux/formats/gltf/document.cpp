#include "isolux/formats/gltf/document.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "isolux/core/error.h"
#include "isolux/core/file.h"

namespace isolux::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

constexpr std::size_t kMostBytes = std::size_t{256} << 20;  // of a file
constexpr std::size_t kMostNumbers = 40'000'000;            // of all accessors that are read
constexpr std::uint64_t kLargest = std::uint64_t{1} << 32;  // counts and offsets

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

/// The JSON of a .glb (§4.4); its binary chunk, if any, goes to `binary`.
std::string_view unpack(const std::string& bytes, std::string& binary, const std::string& file) {
  constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  const auto damaged = [&](const char* what) { throw InputError({file}, what); };
  if (bytes.size() < kHeader + kChunkHeader) damaged("the GLB is cut off");
  if (word_at(bytes, 4) != 2) damaged("the GLB is not of version 2");
  std::string_view json;
  for (std::size_t at = kHeader; at < bytes.size();) {
    if (bytes.size() - at < kChunkHeader) damaged("the GLB is cut off");
    const std::size_t size = word_at(bytes, at);
    const std::uint32_t type = word_at(bytes, at + 4);
    at += kChunkHeader;
    if (size > bytes.size() - at) damaged("the GLB is cut off");
    if (at == kHeader + kChunkHeader) {
      if (type != kJson) damaged("the first chunk of the GLB is not JSON");
      json = std::string_view(bytes).substr(at, size);
    } else if (type == kBinary && binary.empty()) {
      binary = bytes.substr(at, size);
    }
    at += size;
  }
  return json;
}

/// The bytes that base64 (RFC 4648) stands for; nothing where it is none.
std::optional<std::string> from_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  while (text.ends_with('=')) text.remove_suffix(1);
  for (const char c : text) {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+' || c == '-' ? 62
                      : c == '/' || c == '_' ? 63
                                             : -1;
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

/// A URI's path with its %-escapes resolved.
std::string unescaped(const std::string& uri) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      path += static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2]));
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

/// The size of a component in bytes; 0 for unknown types (§3.6.2.2).
std::size_t size_of(int type) {
  constexpr std::array<std::size_t, 7> kSizes = {1, 1, 2, 2, 0, 4, 4};
  return type >= 5120 && type <= 5126 ? kSizes[type - 5120] : 0;
}

template <typename Number>
double component(const char* bytes, bool normalized) {
  Number value;
  std::memcpy(&value, bytes, sizeof value);
  const auto number = static_cast<double>(value);
  if constexpr (std::is_integral_v<Number>) {
    if (normalized) return std::max(number / std::numeric_limits<Number>::max(), -1.0);
  }
  return number;
}

double component(const char* bytes, int type, bool normalized) {
  switch (type) {
    case 5120:
      return component<std::int8_t>(bytes, normalized);
    case 5121:
      return component<std::uint8_t>(bytes, normalized);
    case 5122:
      return component<std::int16_t>(bytes, normalized);
    case 5123:
      return component<std::uint16_t>(bytes, normalized);
    case 5125:
      return component<std::uint32_t>(bytes, normalized);
    default:
      return component<float>(bytes, normalized);
  }
}

}  // namespace

Document::Document(const std::filesystem::path& path) : file_(path.string()), includes_(path) {
  const std::string bytes = read_file(path, kMostBytes);
  const bool packed = bytes.starts_with("glTF");
  std::string_view text = packed ? unpack(bytes, binary_, file_) : std::string_view(bytes);
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  tree_ = parse_json(text, file_);
  buffers_.resize(count("buffers"));
}

std::size_t Document::count(const char* list) const {
  const auto found = root().find(list);
  return found ? found->size() : 0;
}

std::size_t Document::number(const char* list, const Json& index) const {
  const std::uint64_t i = index.integer(kLargest);
  if (i >= count(list)) {
    index.fail(fmt::format("there is no {}[{}], only {} of them", list, i, count(list)));
  }
  return i;
}

Json Document::item(const char* list, const Json& index) const {
  const std::size_t i = number(list, index);
  return root().require(list).item(i);
}

std::string Document::resource(const Json& uri) {
  const std::string& text = uri.text();
  if (!text.starts_with("data:")) {
    try {
      std::string bytes = includes_.open(unescaped(text)).text;
      includes_.close();
      return bytes;
    } catch (const InputError& error) {
      uri.fail(error.what());
    }
  }
  const std::size_t comma = text.find(',');
  const bool encoded = comma != std::string::npos && text.substr(0, comma).ends_with(";base64");
  auto bytes = encoded ? from_base64(std::string_view(text).substr(comma + 1)) : std::nullopt;
  if (!bytes) uri.fail("is no data in base64");
  return std::move(*bytes);
}

std::string_view Document::buffer(const Json& index) {
  const Json owner = item("buffers", index);
  const std::size_t i = number("buffers", index);
  const std::uint64_t length = owner.require("byteLength").integer(kLargest);
  const auto uri = owner.find("uri");
  if (uri && !buffers_[i]) buffers_[i] = resource(*uri);
  if (!uri && i > 0) owner.fail("lacks 'uri'");
  const std::string& bytes = uri ? *buffers_[i] : binary_;
  if (bytes.size() < length) {
    owner.fail(fmt::format("has {} bytes instead of {}", bytes.size(), length));
  }
  return std::string_view(bytes).substr(0, length);
}

std::string_view Document::view(const Json& index, std::size_t& stride) {
  const Json owner = item("bufferViews", index);
  if (owner.extension("EXT_meshopt_compression")) owner.fail("meshopt compression is not read");
  const std::string_view bytes = buffer(owner.require("buffer"));
  const std::uint64_t offset = owner.integer("byteOffset", kLargest, 0);
  const std::uint64_t length = owner.require("byteLength").integer(kLargest);
  if (offset > bytes.size() || length > bytes.size() - offset) owner.fail("leaves its buffer");
  stride = owner.integer("byteStride", 252, 0);
  return bytes.substr(offset, length);
}

std::vector<double> Document::read(const Json& owner, const char* view_key, std::size_t offset,
                                   int type, std::size_t components, std::size_t count,
                                   bool normalized) {
  std::size_t stride = 0;
  const std::string_view bytes = view(owner.require(view_key), stride);
  const std::size_t size = size_of(type);
  if (size == 0) owner.fail("has an unknown component type");
  if (stride == 0) stride = size * components;
  if (count > 0 && (offset > bytes.size() || size * components > bytes.size() - offset ||
                    (count - 1) > (bytes.size() - offset - size * components) / stride)) {
    owner.fail("leaves its buffer view");
  }
  std::vector<double> numbers;
  numbers.reserve(count * components);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < components; ++k) {
      numbers.push_back(component(bytes.data() + offset + i * stride + k * size, type, normalized));
    }
  }
  return numbers;
}

std::vector<double> Document::numbers(const Json& accessor_index, std::size_t components) {
  const Json accessor = item("accessors", accessor_index);
  const std::string type = accessor.require("type").text();
  const char* const expected = components == 1 ? "SCALAR" : "VEC3";
  if (type != expected) accessor.fail(fmt::format("must be of type {}", expected));
  const std::size_t count = accessor.require("count").integer(kLargest);
  numbers_read_ += count * components;
  if (numbers_read_ > kMostNumbers) accessor.fail("the accessors have too many elements");
  const int component_type = static_cast<int>(accessor.require("componentType").integer(65535));
  const bool normalized = accessor.flag("normalized");
  std::vector<double> result;
  if (accessor.find("bufferView")) {
    result = read(accessor, "bufferView", accessor.integer("byteOffset", kLargest, 0),
                  component_type, components, count, normalized);
  } else {
    result.resize(count * components);
  }
  const auto sparse = accessor.find("sparse");
  if (!sparse) return result;
  const std::size_t changed = sparse->require("count").integer(count);
  const Json places = sparse->require("indices"), values = sparse->require("values");
  const auto at =
      read(places, "bufferView", places.integer("byteOffset", kLargest, 0),
           static_cast<int>(places.require("componentType").integer(65535)), 1, changed, false);
  const auto with = read(values, "bufferView", values.integer("byteOffset", kLargest, 0),
                         component_type, components, changed, normalized);
  for (std::size_t i = 0; i < changed; ++i) {
    if (!(at[i] >= 0 && at[i] < static_cast<double>(count))) places.fail("leave the accessor");
    const auto place = static_cast<std::size_t>(at[i]);
    std::copy_n(with.begin() + static_cast<std::ptrdiff_t>(i * components), components,
                result.begin() + static_cast<std::ptrdiff_t>(place * components));
  }
  return result;
}

std::vector<std::uint32_t> Document::indices(const Json& accessor_index, std::size_t limit) {
  std::vector<std::uint32_t> result;
  for (const double number : numbers(accessor_index, 1)) {
    if (!(number >= 0 && number < static_cast<double>(limit))) {
      accessor_index.fail(fmt::format("there is no vertex {}, only {} of them", number, limit));
    }
    result.push_back(static_cast<std::uint32_t>(number));
  }
  return result;
}

std::string Document::image(const Json& image) {
  if (const auto uri = image.find("uri")) {
    try {
      return resource(*uri);
    } catch (const InputError&) {
      return {};  // pictures may be left out
    }
  }
  std::size_t stride = 0;
  return std::string(view(image.require("bufferView"), stride));
}

}  // namespace isolux::gltf
