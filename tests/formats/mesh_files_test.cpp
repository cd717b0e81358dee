#include <cstring>

#include "formats/refusal.h"
#include "isolux/scene/check.h"

// PLY and STL.

namespace isolux {
namespace {
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

template <typename Number>
std::string bytes_of(Number number, bool big = false) {
  std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string ply_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nproperty uchar red\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n";
}

const std::string kSquare = "0 0 0 9\n1 0 0 9\n1 1 0 9\n0 1 0 9\n4 0 1 2 3\n";

std::string binary_square(bool big) {
  std::string bytes;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    for (const float c : {float(x), float(y), 0.f}) bytes += bytes_of(c, big);
    bytes += '\7';
  }
  bytes += '\4';
  for (int i = 0; i < 4; ++i) bytes += bytes_of(i, big);
  return bytes;
}

std::string binary_stl(std::uint32_t says) {
  std::string bytes(80, ' ');
  bytes += bytes_of(says);
  for (int i = 0; i < 12; ++i) bytes += bytes_of(i == 6 || i == 10 ? 1.f : 0.f);
  return bytes + std::string(2, '\0');
}

const std::string kStl =
    "solid tile\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    "endloop\nendfacet\nendsolid tile\n";

TEST(Ply, AllThreeFormatsGiveTheSameSquare) {
  for (const std::string& text :
       {ply_header("ascii") + kSquare, ply_header("binary_little_endian") + binary_square(false),
        ply_header("binary_big_endian") + binary_square(true)}) {
    const SceneFile file = scene_in("square.ply", text);
    ASSERT_EQ(file.scene.objects.size(), 1u);
    EXPECT_EQ(file.scene.objects[0].name, "square");
    EXPECT_NEAR(surface_area(*file.scene.objects[0].shape).value(), 1, 1e-12);
    EXPECT_EQ(file.scene.objects[0].shape->face_count(), 1u);
    EXPECT_THAT(file.notes, Contains(HasSubstr("no unit of length in the file: metres")));
    EXPECT_THAT(check_scene(file.scene).warnings, Contains(HasSubstr("nothing gives light")));
  }
}

TEST(Ply, ErrorsGiveTheExactPlace) {
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::pair<std::string, const char*> cases[] = {
      {"", "a.ply:1:1: the header does not end"},
      {"play\nend_header\n", "a.ply:1:1: a PLY file begins with the word ply"},
      {"ply\nformat utf8 1.0\nend_header\n", "a.ply:2:8: there is no format 'utf8'"},
      {head + "element vertex -1\nend_header\n", "a.ply:3:16: expected a whole number"},
      {head + "element vertex\nend_header\n", "a.ply:3:1: 'element' lacks an argument"},
      {head + "property float x\nend_header\n", "a.ply:3:1: this property has no element"},
      {head + "element vertex 1\nproperty flat x\nend_header\n", "a.ply:4:10: there is no type"},
      {head + "elephant\nend_header\n", "a.ply:3:1: 'elephant' is no word of a PLY header"},
      {ply_header("ascii") + "0 0 0 9\n1 zero", "a.ply:13:3: expected a finite number, not 'zero'"},
      {ply_header("ascii") + "0 0 .nan 9\n", "a.ply:12:5: expected a finite number, not '.nan'"},
      {ply_header("ascii") + "0 0 0 9", "a.ply:12:8: the file ends too early"},
      {ply_header("ascii") + "0 2e9 0 9", "a.ply:12:3: vertex 0 must lie between"},
      {ply_header("ascii") + "0 0 0 9 1 0 0 9 1 1 0 9 0 1 0 9 1e9",
       "a.ply:12:33: a list can't have 1000000000 items"},
      {ply_header("ascii") + "0 0 0 9 1 0 0 9 1 1 0 9 0 1 0 9 3 0 1 4",
       "a.ply: face 0: there is no vertex 4, only 4"},
      {ply_header("binary_little_endian") + "abc", "a.ply: the file ends too early"},
      {head + "element vertex 0\nproperty float x\nend_header\n",
       "a.ply: the scene has no surfaces"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(refusal_of("a.ply", text), StartsWith(expected)) << text;
  }
}

TEST(Stl, TextAndBinary) {
  for (const std::string& text : {kStl, binary_stl(1)}) {
    const SceneFile file = scene_in("a.stl", text);
    ASSERT_EQ(file.scene.objects.size(), 1u);
    EXPECT_EQ(file.scene.objects[0].name, text == kStl ? "tile" : "a");
    EXPECT_NEAR(surface_area(*file.scene.objects[0].shape).value(), 0.5, 1e-12);
    EXPECT_FALSE(file.scene.has_light());
  }
}

TEST(Stl, ErrorsGiveTheExactPlace) {
  const std::pair<std::string, const char*> cases[] = {
      {"", "a.stl: the scene has no surfaces"},
      {"liquid\n", "a.stl:1:1: expected 'solid', not 'liquid'"},
      {"solid a\n", "a.stl: the file ends within a solid"},
      {"solid a\nfacets\n", "a.stl:2:1: expected 'facet', not 'facets'"},
      {"solid a\nfacet normal 0 0 1\nvertex 0 0 0\n", "a.stl:3:1: expected 'outer', not 'vertex'"},
      {"solid a\nfacet\nouter loop\nvertex 0 0\n", "a.stl:4:1: 'vertex' lacks an argument"},
      {"solid a\nfacet\nouter loop\nvertex 0 0 a\n", "a.stl:4:12: expected a number, not 'a'"},
      {"solid a\nfacet\nouter loop\nvertex 0 -1e10 0\n", "a.stl:4:10: must lie between"},
      {binary_stl(2), "a.stl: the file is cut off, or no STL"},
      {"solid a\nendsolid\n", "a.stl: the scene has no surfaces"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(refusal_of("a.stl", text), StartsWith(expected)) << text;
  }
  std::string infinite = binary_stl(1);
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + 96, &infinity, 4);
  EXPECT_THAT(refusal_of("a.stl", infinite), StartsWith("a.stl: triangle 0: coordinates must lie"));
}

TEST(MeshFiles, DamagedFilesDoNoHarm) {
  expect_no_harm("a.ply", ply_header("ascii") + kSquare, 1000);
  expect_no_harm("a.ply", ply_header("binary_little_endian") + binary_square(false), 1000);
  expect_no_harm("a.stl", kStl, 1000);
  expect_no_harm("a.stl", binary_stl(1), 1000);
}

}  // namespace
}  // namespace isolux
