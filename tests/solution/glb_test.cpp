#include "isolux/solution/glb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/core/error.h"

namespace isolux {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Glb, RoundTripKeepsJsonAndBinaryInAlignedChunks) {
  for (std::size_t size = 0; size < 9; ++size) {
    Glb glb;
    glb.json = {{"name", std::string(size, 'x')}};
    glb.binary.assign(4 * size, 'b');
    const std::string bytes = encode_glb(glb);
    EXPECT_EQ(bytes.size() % 4, 0u);
    const Glb back = decode_glb(bytes);
    EXPECT_EQ(back.json, glb.json);
    EXPECT_EQ(back.binary, glb.binary);
  }
}

TEST(Glb, ArraysOfEveryTypeComeBack) {
  Glb glb;
  const std::vector<float> floats = {1, 2, 3, 4, 5, 6};
  const std::vector<std::uint8_t> bytes = {7, 8, 9};
  add_array<std::uint8_t>(glb, bytes, 1);
  const int index = add_array<float>(glb, floats, 3, BufferTarget::vertices);
  glb = decode_glb(encode_glb(glb));
  EXPECT_EQ(accessor_count(glb, static_cast<std::uint64_t>(index)), 2u);
  EXPECT_EQ(read_array<float>(glb, static_cast<std::uint64_t>(index), 3, 2), floats);
  EXPECT_THAT(read_array<std::uint8_t>(glb, 0, 1, 3), ElementsAre(7, 8, 9));
}

TEST(Glb, NestingAndLengthOfJsonAreBounded) {
  const auto with_json = [](const std::string& json) {
    const auto word = [](std::size_t n) {
      const auto w = static_cast<std::uint32_t>(n);
      return std::string(reinterpret_cast<const char*>(&w), 4);
    };
    return "glTF" + word(2) + word(20 + json.size()) + word(json.size()) + "JSON" + json;
  };
  const auto far_too_large = ThrowsMessage<InputError>(HasSubstr("far too large"));
  EXPECT_THAT([&] { decode_glb(with_json(std::string(1'000'000, '['))); }, far_too_large);
  std::string list = "[0";
  for (int i = 0; i < 1'000'000; ++i) list += ",0";
  EXPECT_THAT([&] { decode_glb(with_json(list + "]")); }, far_too_large);
  EXPECT_THAT([&] { decode_glb(with_json("[1e999]")); },
              ThrowsMessage<InputError>(HasSubstr("out of range")));
  EXPECT_THAT([&] { decode_glb(with_json("{\"a\": }")); },
              ThrowsMessage<InputError>(HasSubstr("malformed")));
}

}  // namespace
}  // namespace isolux
