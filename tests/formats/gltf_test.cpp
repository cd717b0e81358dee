#include <fmt/format.h>

#include <cstring>
#include <numbers>

#include "formats/refusal.h"
#include "isolux/geometry/instance.h"

namespace isolux {
namespace {
using std::numbers::pi;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

/// A unit square in z = 0 that faces +z: four points (48 bytes), six indices (12), and for a sparse
/// accessor an index 2 and the point (2, 2, 0).
std::string square_bytes() {
  std::string bytes;
  const auto add = [&](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  for (const int c : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) add(static_cast<float>(c));
  for (const int i : {0, 1, 2, 0, 2, 3}) add(static_cast<std::uint16_t>(i));
  add(std::uint32_t{2});
  for (const int c : {2, 2, 0}) add(static_cast<float>(c));
  return bytes;
}

/// A file with the square as mesh 0, of material 0, and whatever else `members` says; `sparse`
/// stands in the accessor of its points.
std::string square_file(const std::string& members, const std::string& sparse = "",
                        const std::string& uri = base64(square_bytes())) {
  const std::string source =
      uri.empty() ? "" : fmt::format(R"(, "uri": "data:application/octet-stream;base64,{}")", uri);
  return fmt::format(R"({{"asset": {{"version": "2.0"}},
"buffers": [{{"byteLength": 76{}}}],
"bufferViews": [{{"buffer": 0, "byteLength": 48}},
  {{"buffer": 0, "byteOffset": 48, "byteLength": 12}},
  {{"buffer": 0, "byteOffset": 60, "byteLength": 4}},
  {{"buffer": 0, "byteOffset": 64, "byteLength": 12}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"{}}},
  {{"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}}],
"meshes": [{{"name": "square", "primitives":
  [{{"attributes": {{"POSITION": 0}}, "indices": 1, "material": 0}}]}}],
{}}})",
                     source, sparse, members);
}

const std::string kGray = R"("materials": [{"name": "gray", "doubleSided": true,
  "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1], "metallicFactor": 0}}],)";
const std::string kOne = R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])";

std::string glb(const std::string& json, const std::string& binary) {
  const auto word = [](std::size_t n) {
    const auto w = static_cast<std::uint32_t>(n);
    return std::string(reinterpret_cast<const char*>(&w), 4);
  };
  std::string text = json + std::string((4 - json.size() % 4) % 4, ' ');
  return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" +
         text + word(binary.size()) + std::string("BIN\0", 4) + binary;
}

TEST(Gltf, TimeToReadGrowsWithTheSizeAlone) {
  std::string nodes = "{}";
  for (int i = 0; i < 300'000; ++i) nodes += ",{}";
  EXPECT_EQ(refusal_of("a.gltf", R"({"asset": {"version": "2.0"}, "nodes": [)" + nodes + "]}"),
            "a.gltf: the scene has no surfaces");
}

TEST(Gltf, ASquareFromJsonAndFromGlb) {
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"a.gltf", square_file(kGray + kOne)},
        {"a.glb", glb(square_file(kGray + kOne, "", ""), square_bytes())}}) {
    const SceneFile file = scene_in(name, text);
    ASSERT_EQ(file.scene.objects.size(), 1u);
    const Object& square = file.scene.objects[0];
    EXPECT_EQ(square.name, "square");
    EXPECT_EQ(square.sides, Sides::both);
    EXPECT_NEAR(surface_area(*square.shape).value(), 1, 1e-12);
    EXPECT_EQ(file.scene.materials.at(0).reflectance, (Rgb{0.5, 0.25, 0.125}));
    EXPECT_TRUE(file.notes.empty());
    EXPECT_EQ(file.scene.cameras.at(0).up, (Vec3{0, 1, 0}));
  }
}

TEST(Gltf, SparseAccessorsReplaceElements) {
  const Scene scene = scene_in("a.gltf", square_file(kGray + kOne, R"(, "sparse": {"count": 1,
        "indices": {"bufferView": 2, "componentType": 5125}, "values": {"bufferView": 3}})"))
                          .scene;
  EXPECT_NEAR(surface_area(*scene.objects.at(0).shape).value(), 2, 1e-12);
}

// Translations, turns and scales nest; a mirror image keeps its front.
TEST(Gltf, NodesPlaceMeshes) {
  const Scene scene =
      scene_in("a.gltf", square_file(kGray + R"("scenes": [{"nodes": [0, 2]}], "nodes": [
    {"translation": [0, 0, 5], "scale": [2, 2, 2], "children": [1]},
    {"mesh": 0, "name": "turned", "rotation": [0, 0.70710678, 0, 0.70710678]},
    {"mesh": 0, "name": "mirrored", "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 7,0,0,1]}])"))
          .scene;
  ASSERT_EQ(scene.objects.size(), 2u);
  const Bounds turned = scene.objects[0].shape->bounds();
  EXPECT_LT(distance(turned.lower, {0, 0, 3}), 1e-6);
  EXPECT_LT(distance(turned.upper, {0, 2, 5}), 1e-6);
  Hits hits;
  scene.objects[1].shape->intersect({{6.5, 0.25, 1}, {0, 0, -1}}, hits);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_NEAR(hits[0].normal.z, 1, 1e-12);
}

// Also after the scene went through native text.
TEST(Gltf, MeshesOfManyNodesAreOneInMemory) {
  std::string nodes, numbers;
  for (int i = 0; i < 1000; ++i) {
    nodes += fmt::format("{}{{\"mesh\": 0, \"translation\": [{}, 0, 0]}}", i ? "," : "", i);
    numbers += fmt::format("{}{}", i ? "," : "", i);
  }
  const Scene scene = scene_in("a.gltf", square_file(kGray + R"("scenes": [{"nodes": [)" + numbers +
                                                     R"(]}], "nodes": [)" + nodes + "]"))
                          .scene;
  ASSERT_EQ(scene.objects.size(), 1000u);
  for (const Object& object : scene.objects) {
    EXPECT_EQ(original(object.shape).shape, original(scene.objects[0].shape).shape);
  }
  EXPECT_EQ(scene.objects[999].shape->bounds().lower.x, 999);
}

// 10 × 3 cd/m² (red) in front of π: the exitance of a diffuse surface; times 1 m².
TEST(Gltf, EmissionIsLuminance) {
  const SceneFile file =
      scene_in("a.gltf", square_file(R"("extensionsRequired": ["KHR_materials_emissive_strength"],
"materials": [{"emissiveFactor": [1, 0.5, 0], "alphaMode": "BLEND",
  "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 30}}}],)" +
                                     kOne));
  const Object& square = file.scene.objects.at(0);
  EXPECT_NEAR(square.exitance.r, 30 * pi, 1e-9);
  EXPECT_NEAR(square.exitance.g, 15 * pi, 1e-9);
  EXPECT_NEAR(luminous_flux(square), pi * luminance(Rgb{30, 15, 0}), 1e-6);
  for (const char* note : {"metals", "'alphaMode' left out", "reduced to 0.999"}) {
    EXPECT_THAT(file.notes, Contains(HasSubstr(note)));
  }
}

TEST(Gltf, ColorsOfVerticesAreNoted) {
  std::string text = square_file(R"("materials": [{}],)" + kOne);
  const std::string position = "\"POSITION\": 0";
  text.replace(text.find(position), position.size(), position + ", \"COLOR_0\": 0");
  EXPECT_THAT(scene_in("a.gltf", text).notes, Contains(HasSubstr("'COLOR_0' left out")));
}

TEST(Gltf, TexturesCountWithTheirMean) {
  // A PNG of two texels, black and white.
  const std::string png =
      "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR4nGNg+A8AAQIBAEK+"
      "vGgAAAAASUVORK5CYII=";
  const SceneFile file = scene_in(
      "a.gltf", square_file(fmt::format(R"("images": [{{"uri": "data:image/png;base64,{}"}}],
"textures": [{{"source": 0}}], "materials": [{{"pbrMetallicRoughness":
  {{"baseColorTexture": {{"index": 0}}, "baseColorFactor": [0.5, 1, 1, 1], "metallicFactor": 0}}}}],)",
                                        png) +
                            kOne));
  EXPECT_NEAR(file.scene.materials.at(0).reflectance.r, 0.25, 1e-9);
  EXPECT_NEAR(file.scene.materials.at(0).reflectance.g, 0.5, 1e-9);
  EXPECT_THAT(file.notes, Contains(HasSubstr("mean color alone")));
}

TEST(Gltf, LightsAndCamerasOfNodes) {
  const Scene scene = scene_in("a.gltf", square_file(kGray + R"(
"extensions": {"KHR_lights_punctual": {"lights": [
  {"type": "point", "intensity": 100, "color": [1, 0.5, 0]},
  {"type": "spot", "intensity": 50, "spot": {"innerConeAngle": 0.5235987755982988,
    "outerConeAngle": 1.0471975511965976}},
  {"type": "directional", "intensity": 1000}]}},
"cameras": [{"type": "perspective", "perspective": {"yfov": 1.5707963267948966, "aspectRatio": 2}}],
"scenes": [{"nodes": [0, 1, 2, 3, 4]}], "nodes": [{"mesh": 0},
  {"translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}},
  {"extensions": {"KHR_lights_punctual": {"light": 1}}},
  {"rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476],
    "extensions": {"KHR_lights_punctual": {"light": 2}}},
  {"camera": 0, "translation": [0, 0, 4]}])"))
                          .scene;
  ASSERT_EQ(scene.sources.size(), 3u);
  EXPECT_EQ(scene.sources[0].position, (Vec3{1, 2, 3}));
  EXPECT_EQ(scene.sources[0].intensity, (Rgb{100, 50, 0}));
  EXPECT_NEAR(scene.sources[1].full_angle, 30, 1e-9);
  EXPECT_NEAR(scene.sources[1].dark_angle, 60, 1e-9);
  EXPECT_EQ(scene.sources[2].kind, Source::Kind::directional);
  EXPECT_LT(distance(scene.sources[2].direction, {0, -1, 0}), 1e-9);
  const Camera& camera = scene.cameras.at(0);
  EXPECT_NEAR(camera.fov, 90, 1e-9);
  EXPECT_EQ(camera.width, 1200);
  EXPECT_LT(distance(camera.eye, {0, 0, 4}), 1e-12);
  EXPECT_LT(distance(camera.look_at, {0, 0, 3}), 1e-12);
}

TEST(Gltf, ErrorsNameTheValue) {
  const std::string rest = kGray + kOne;
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = square_file(rest);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  const std::pair<std::string, const char*> cases[] = {
      {"", "a.gltf:1:1: the JSON is malformed here"},
      {"{\n \"asset\": }", "a.gltf:2:11: the JSON is malformed here"},
      {"[]", "a.gltf:1:1: the JSON must be an object"},
      {"{}", "a.gltf: lacks 'asset'"},
      {std::string(100, '['), "a.gltf: the JSON is too deep"},
      {replaced("2.0", "1.0"), "a.gltf: is glTF '1.0': only 2.0 is read"},
      {replaced("\"mesh\": 0", "\"mesh\": 7"), "a.gltf: nodes[0].mesh: there is no meshes[7]"},
      {replaced("\"mesh\": 0", "\"mesh\": -1"), "a.gltf: nodes[0].mesh: must be a whole number"},
      {replaced("\"mesh\": 0", "\"mesh\": \"a\""), "a.gltf: nodes[0].mesh: must be a number"},
      {replaced("{\"mesh\"", "{\"children\": [0], \"mesh\""),
       "a.gltf: nodes[0].children[0]: nodes[0] is placed twice"},
      {replaced("{\"mesh\"", "{\"scale\": [1, 0, 1], \"mesh\""),
       "a.gltf: nodes[0]: is scaled to nothing"},
      {replaced("\"count\": 6", "\"count\": 4000000000"),
       "a.gltf: accessors[1]: the accessors have too many elements"},
      {replaced("\"count\": 6", "\"count\": 7"), "a.gltf: accessors[1]: leaves its buffer view"},
      {replaced("\"count\": 4", "\"count\": 3"),
       "a.gltf: meshes[0].primitives[0].indices: there is no vertex 3, only 3"},
      {replaced("\"byteLength\": 12", "\"byteLength\": 99"),
       "a.gltf: bufferViews[1]: leaves its buffer"},
      {replaced("\"byteLength\": 76", "\"byteLength\": 77"),
       "a.gltf: buffers[0]: has 76 bytes instead of 77"},
      {replaced("5123", "5124"), "a.gltf: accessors[1]: has an unknown component type"},
      {replaced("\"VEC3\"", "\"VEC2\""), "a.gltf: accessors[0]: must be of type VEC3"},
      {replaced("data:application/octet-stream;base64,", "../../a.bin#"),
       "a.gltf: buffers[0].uri: '../../a.bin#"},
      {square_file(R"("extensionsRequired": ["KHR_draco_mesh_compression"],)" + rest),
       "a.gltf: extensionsRequired[0]: 'KHR_draco_mesh_compression' is not read"},
      {square_file(R"("extras": {"isolux": {}},)" + rest), "a.gltf: is a solution of isolux"},
      {square_file(kGray + R"("nodes": [])"), "a.gltf: the scene has no surfaces"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(refusal_of("a.gltf", text), StartsWith(expected)) << text.substr(0, 200);
  }
  const std::string whole = glb(square_file(rest, "", ""), square_bytes());
  EXPECT_EQ(refusal_of("a.glb", whole.substr(0, 15)), "a.glb: the GLB is cut off");
  EXPECT_EQ(refusal_of("a.glb", whole.substr(0, whole.size() - 1)), "a.glb: the GLB is cut off");
}

TEST(Gltf, DamagedFilesDoNoHarm) {
  const std::string rest =
      R"("extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},)" + kGray +
      R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0, "rotation": [0, 0, 0, 1]},
        {"mesh": 0, "translation": [0, 0, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}}])";
  expect_no_harm("a.gltf", square_file(rest), 2000);
  expect_no_harm("a.glb", glb(square_file(rest, "", ""), square_bytes()), 2000);
}

}  // namespace
}  // namespace isolux
