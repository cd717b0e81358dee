#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/core/random.h"
#include "isolux/solution/glb.h"
#include "isolux/solution/solution.h"
#include "solution/small_solution.h"

namespace isolux {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

class DamagedSolution : public ::testing::Test {
 protected:
  void SetUp() override {
    save_solution(small_solution(), folder_ / "whole.glb");
    whole_ = read_file(folder_ / "whole.glb");
  }

  Solution load(const std::string& bytes) {
    write_file(folder_ / "damaged.glb", bytes);
    return load_solution(folder_ / "damaged.glb");
  }

  /// Expects one line that names the file and says `message`.
  void expect_error(const std::string& bytes, const std::string& message) {
    EXPECT_THAT([&] { load(bytes); },
                ThrowsMessage<InputError>(
                    AllOf(HasSubstr("damaged.glb"), HasSubstr(message), Not(HasSubstr("\n")))));
  }

  void expect_error(const Glb& glb, const std::string& message) {
    expect_error(encode_glb(glb), message);
  }

  TemporaryFolder folder_;
  std::string whole_;
};

TEST_F(DamagedSolution, TruncatedAnywhereIsRefused) {
  for (std::size_t size = 12; size < whole_.size(); size += size < 200 ? 1 : 61) {
    expect_error(whole_.substr(0, size), "is truncated: ");
  }
  for (std::size_t size = 0; size < 12; ++size) {
    EXPECT_THROW(load(whole_.substr(0, size)), InputError);
  }
}

TEST_F(DamagedSolution, TimeToReadGrowsWithTheSizeAlone) {
  Glb glb = decode_glb(whole_);
  glb.json["nodes"] = std::vector<json>(300'000, json::object());
  load(encode_glb(glb));
}

TEST_F(DamagedSolution, ForeignFilesAreRefused) {
  expect_error("", "is not a solution of isolux");
  expect_error("isolux: 1\nname: a scene\n", "is not a solution of isolux");
  expect_error(std::string("\x89PNG\r\n\x1a\n"), "is not a solution of isolux");
  expect_error(whole_ + "x", "1 bytes follow its end");
  Glb foreign;
  foreign.json = {{"asset", {{"version", "2.0"}}}};
  expect_error(foreign, "is not a solution of isolux: its JSON lacks 'extras'");
  EXPECT_THROW(load_solution(folder_ / "absent.glb"), InputError);
}

TEST_F(DamagedSolution, FlippedBitsNeverCrash) {
  Random random(1);
  int loaded = 0;
  constexpr int kTrials = 1500;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string bytes = whole_;
    for (std::uint64_t flips = 1 + random.below(3); flips > 0; --flips) {
      bytes[random.below(bytes.size())] ^= static_cast<char>(1 << random.below(8));
    }
    try {
      load(bytes);
      ++loaded;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("damaged.glb"));
    }
  }
  EXPECT_LT(loaded, kTrials);
}

TEST_F(DamagedSolution, HostileJsonIsRefused) {
  const json huge = 4294967295u, negative = -1, beyond = std::uint64_t{1} << 63;
  const std::string primitive = "/meshes/0/primitives/0", about = "/extras/isolux";
  const std::vector<std::pair<std::string, json>> changes = {
      {primitive + "/indices", huge},
      {primitive + "/indices", negative},
      {primitive + "/indices", "0"},
      {primitive + "/attributes/POSITION", 99},
      {primitive + "/attributes", json::array()},
      {"/meshes", json::array()},
      {"/meshes/0/primitives", 3},
      {"/accessors", "none"},
      {"/accessors/0/count", huge},
      {"/accessors/0/count", beyond},
      {"/accessors/0/count", 2.5},
      {"/accessors/0/type", "VEC4"},
      {"/accessors/0/type", json::object()},
      {"/accessors/0/componentType", 5120},
      {"/accessors/0/bufferView", huge},
      {"/accessors/0/byteOffset", huge},
      {"/accessors/0/sparse", json::object()},
      {"/bufferViews/0/byteOffset", huge},
      {"/bufferViews/0/byteOffset", negative},
      {"/bufferViews/0/byteLength", 1},
      {"/bufferViews/0/byteStride", 400},
      {"/bufferViews/0/buffer", 1},
      {about, json::array()},
      {about + "/format", 2},
      {about + "/scene", 1},
      {about + "/scene", "isolux: 1\nobjects: [nonsense"},
      {about + "/version", json()},
      {about + "/triangles/shot", huge},
      {about + "/triangles/on_light", 0},
      {about + "/options", json()},
      {about + "/options/max_edge", 0},
      {about + "/options/max_edge", 1e-300},
      {about + "/options/max_edge", "2"},
      {about + "/options/normal_tolerance", 4},
      {about + "/options/subdivisions", 1'000'000},
      {about + "/options/pairing_tolerance", -1},
      {about + "/options/selection", "none"},
      {about + "/options/refine", 1},
      {about + "/statistics/triangles", negative},
      {about + "/statistics/mesh_area", "large"},
  };
  for (const auto& [where, value] : changes) {
    SCOPED_TRACE(where + " = " + value.dump());
    Glb glb = decode_glb(whole_);
    glb.json[json::json_pointer(where)] = value;
    expect_error(glb, "damaged.glb");
  }
}

TEST_F(DamagedSolution, HostileNumbersAreRefused) {
  const Glb good = decode_glb(whole_);
  const json& primitive = good.json["meshes"][0]["primitives"][0];
  const auto with_bytes = [&](const json& accessor, const auto& number) {
    Glb glb = good;
    const json& entry = glb.json["accessors"][accessor.get<std::size_t>()];
    const json& view = glb.json["bufferViews"][entry["bufferView"].get<std::size_t>()];
    std::memcpy(glb.binary.data() + view["byteOffset"].get<std::size_t>(), &number, sizeof number);
    return glb;
  };
  const auto attribute = [&](const char* name, float number) {
    return with_bytes(primitive["attributes"][name], number);
  };
  const json& triangles = good.json["extras"]["isolux"]["triangles"];
  expect_error(with_bytes(primitive["indices"], 4294967295u), "there is no vertex 4294967295");
  expect_error(with_bytes(primitive["indices"], 1u), "without three vertices");
  expect_error(with_bytes(triangles["on_light"], std::uint8_t{0}), "lies on a light in part");
  expect_error(with_bytes(triangles["shot"], std::nanf("")), "'shot' holds a number");
  expect_error(attribute("POSITION", HUGE_VALF), "'POSITION' holds a number");
  expect_error(attribute("POSITION", 1e30f), "outside the scene");
  expect_error(attribute("NORMAL", 7), "has not length 1");
  expect_error(attribute("_REFLECTANCE", -1), "not from 0 to 1");
  expect_error(attribute("_IRRADIANCE", std::nanf("")), "'_IRRADIANCE' holds a number");
  expect_error(attribute("_OBJECT", 3), "on object 3");
  expect_error(attribute("_OBJECT", 0.5f), "on object 0.5");
  expect_error(attribute("_FACE", -1), "on face -1");
}

}  // namespace
}  // namespace isolux
