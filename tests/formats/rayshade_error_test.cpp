// Malformed scenes: each ends in one line with its place; none in a crash or a hang.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "formats/rayshade_text.h"
#include "isolux/core/random.h"

namespace isolux {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(RayshadeErrors, NameTheirPlaceAndTheMend) {
  struct Case {
    std::string text, place, phrase;
  };
  const Case cases[] = {
      {"sphere 1 0 0 0\nspheer 1 0 0 0", "2:1: ", "did you mean 'sphere'?"},
      {"list\n  sphere 1 0 0 0\n  ligth\nend", "3:3: ", "unknown word 'ligth'"},
      {"sphere 1 0 0", "1:13: ", "a number must stand here, not the end of the file"},
      {"sphere 1 0 0 box 0 0 0 1 1 1", "1:14: ", "a number must stand here, not 'box'"},
      {"sphere -1 0 0 0", "1:1: ", "'sphere' can't be made: radius"},
      {"\n  box 0 0 0 1 1 0", "2:3: ", "'box' can't be made"},
      {"torus 1 2 0 0 0 0 0 1", "1:1: ", "minor_radius"},
      {"plane 0 0 0 0 0 0", "1:1: ", "'plane' can't be made: normal"},
      {"sphere 1 0 0 0 7", "1:16: ", "number too many"},
      {"surface red diffuse .5 0 0\nsphere rde 1 0 0 0", "2:8: ", "did you mean 'red'?"},
      {"object chair", "1:8: ", "no object is named 'chair'"},
      {"name sphere box 0 0 0 1 1 1", "1:6: ", "'sphere', a word of the language"},
      {"name a surface b", "1:8: ", "an object must follow the name 'a'"},
      {"\nlist\nsphere 1 0 0 0", "2:1: ", "this 'list' lacks its 'end'"},
      {"union sphere 1 0 0 0 end", "1:1: ", "needs two objects"},
      {"union sphere 1 0 0 0\n triangle 0 0 0 1 0 0 0 1 0 end", "2:2: ", "leave holes"},
      {"union sphere 1 0 0 0\n disc 1 0 0 0 0 0 1 end", "2:2: ", "'disc' is open"},
      {"union sphere 1 0 0 0\n list end end", "2:2: ", "this 'list' is empty"},
      {"intersect sphere 1 0 0 0 sphere 1 9 0 0 end", "1:1: ", "nothing is left"},
      {"sphere 1 0 0 0 scale 0 1 1", "1:16: ", "'scale' flattens the object"},
      {"sphere 1 0 0 0 rotate 0 0 0 9", "1:23: ", "axis"},
      {"sphere (1/0) 0 0 0", "1:8: ", "no finite number"},
      {"sphere (1 + radius) 0 0 0", "1:13: ", "unknown variable 'radius'"},
      {"sphere (sine(1)) 0 0 0", "1:9: ", "did you mean 'sin'?"},
      {"sphere (hypot(1)) 0 0 0", "1:16: ", "',' must stand here, not ')'"},
      {"sphere (1 0 0 0", "1:11: ", "')' must stand here"},
      {"sphere 1e999 0 0 0", "1:8: ", "too large"},
      {"sphere 1x 0 0 0", "1:8: ", "'1x' is no number"},
      {"sphere 1 0 0 $", "1:14: ", "'$' has no meaning here"},
      {"define a 1\ndefine a 2\n", "2:8: ", "variable 'a' is there already"},
      {"sphere 1 0 0 0\n/* no end", "2:1: ", "this comment never ends"},
      {"#ifdef A\nsphere 1 0 0 0", "1:2: ", "lacks its '#endif'"},
      {"#endif\nsphere 1 0 0 0", "1:2: ", "'#endif' without a condition"},
      {"#includ \"a.ray\"", "1:2: ", "did you mean 'include'?"},
      {"#include \"no-such.ray\"", "1:2: ", "no file 'no-such.ray'"},
      {"#include \"../../etc/passwd\"", "1:2: ", "outside the folder of the scene"},
      {"#include \"/etc/passwd\"", "1:2: ", "can't be included"},
      {"#include \"test.ray\"", "1:2: ", "'test.ray' includes itself"},
      {"#define F(x) x\nsphere F(1, 2) 0 0 0", "2:8: ", "takes 1 arguments, not 2"},
      {"#define F(x) x\nsphere F(1 0 0 0", "2:8: ", "lacks its ')'"},
      {"sphere\n  R 0 0 0", "2:3: ", "unknown surface 'R'"},
      {"#define R (1 +)\nsphere R 0 0 0", "2:8: ", "a number must stand here, not ')'"},
      {"light 1 lamp 0 0 0", "1:9: ", "unknown kind of light 'lamp'"},
      {"light -1 point 0 0 5\nsphere 1 0 0 0", "1:1: ", "intensity"},
      {"light 1 spot 0 0 5 0 0 0 1 30 20", "1:1: ", "angles of a spot light must rise"},
      {"light 1 directional 0 0 0", "1:1: ", "direction of a light must not be 0"},
      {"sphere 1 0 0 0\nup 0 1 0", "2:1: ", "'up' not along it"},
      {"fov 180", "1:1: ", "between 0 and 180"},
      {"screen 0 100", "1:1: ", "pixels a side"},
      {"eyep 0 1e300 0", "1:6: ", "this point: coordinates"},
      {"surface s diffuse -1 0 0", "1:19: ", "a color must not be negative"},
      {"sphere 1 0 0 0 texture wod", "1:24: ", "did you mean 'wood'?"},
      {"heightfield no-such.hf", "1:13: ", "no file"},
      {"", "1:1: ", "the scene is empty"},
      {"eyep 0 -1e12 0\nsphere 1 0 0 0", "2:1: ", "the scene is 1e+12 m large"},
      {"sphere 1 0 0 0\nlight 1 extended 1e-9 0 0 9", "2:1: ", "too bright for its size"},
      {"list end diffuse 1 1 1", "1:10: ", "'diffuse' can't stand here"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const std::string message = rayshade_refusal(c.text);
    EXPECT_THAT(message, StartsWith(c.place));
    EXPECT_THAT(message, HasSubstr(c.phrase));
    EXPECT_THAT(message, testing::Not(HasSubstr("\n")));
  }
}

TEST(RayshadeErrors, InAnIncludedFileAreItsOwn) {
  write_scene("\n\n   sphere 1 0 zero 0\n", "part.ray");
  EXPECT_THAT(rayshade_refusal("#include \"part.ray\"\n"), HasSubstr("part.ray:3:15: "));
}

TEST(RayshadeErrors, WhateverIsTooMuchIsRefused) {
  std::string opened, parentheses = "sphere ", names = "name n0 sphere 1 0 0 0\n", macros, doubled;
  for (int i = 0; i < 100'000; ++i) opened += "list ", parentheses += '(';
  EXPECT_THAT(rayshade_refusal(opened), HasSubstr("nested more than"));
  EXPECT_THAT(rayshade_refusal(parentheses), HasSubstr("nested too deep"));
  std::string chain = names;
  for (int i = 1; i < 60; ++i) {
    names += fmt::format("name n{} list object n{} object n{} end\n", i, i - 1, i - 1);
    macros += fmt::format("#define M{} M{} M{}\n", i, i + 1, i + 1);
  }
  EXPECT_THAT(rayshade_refusal(names + "object n59"), HasSubstr("more than 250000 objects"));
  std::string bits =
      "surface a diffuse 1 0 0 surface b diffuse 0 1 0\nname s0 union sphere a 1 0 0 0 "
      "sphere b 1 1 0 0 end\n";
  for (int i = 1; i < 17; ++i) {
    bits += fmt::format("name s{0} union object s{1} object s{1} end\n", i, i - 1);
  }
  std::string places, lists = "name t0 object s16\n";
  for (int i = 1; i < 30; ++i) {
    places += "object s14\n";
    lists += fmt::format("name t{} union object t{} sphere 1 0 0 0 end\n", i, i - 1);
  }
  EXPECT_THAT(rayshade_refusal(bits + places), HasSubstr("more than 250000 parts"));
  EXPECT_THAT(rayshade_refusal(bits + lists + "object t29"), HasSubstr("too many surfaces"));
  EXPECT_THAT(rayshade_refusal(macros + "M1"), HasSubstr("the macros make more than 64 MiB"));
  for (int i = 1; i < 200; ++i) {
    chain += fmt::format("name n{} object n{}\n", i, i - 1);
  }
  EXPECT_THAT(rayshade_refusal(chain + "object n199"), HasSubstr("nested more than"));
  for (int i = 0; i < 40; ++i) doubled += fmt::format("#define D{}(x) x x\n", i);
  doubled += "sphere ";
  for (int i = 0; i < 40; ++i) doubled += fmt::format("D{}(", i);
  doubled += std::string(40, ')');
  EXPECT_NE(rayshade_refusal(doubled), "");
}

// Whatever is cut off or flipped: a scene or one InputError, nothing else.
TEST(RayshadeErrors, MutilatedScenesEndInASceneOrAnInputError) {
  const std::string whole =
      "#define R 1.5 /* radius */\n#ifdef R\ndefine n (2*R)\n#endif\n"
      "surface red diffuse .5 .1 .1 specular .2 .2 .2\n"
      "name rod list cylinder R 0 0 0 0 0 3 disc R 0 0 0 0 0 -1 disc R 0 0 3 0 0 1 end\n"
      "difference box red -2 -2 0 2 2 3 object rod scale .5 .5 2 end rotate 0 0 1 (n*15)\n"
      "blob .3 1 1 0 0 4 1 1 .5 0 4\nplane 0 0 -1 0 0 1 texture checker red scale 2 2 2\n"
      "triangle 0 0 0 1 0 0 0 1 0 poly 0 0 5 1 0 5 1 1 5 0 1 5\n"
      "light 1 point 5 5 9 light .3 area 0 0 9 1 0 9 2 0 1 9 2\neyep 0 -9 3 fov 30 screen 90 60\n";
  ASSERT_EQ(rayshade_refusal(whole), "");
  for (std::size_t size = 0; size < whole.size(); size += 5)
    rayshade_refusal(whole.substr(0, size));
  const std::string letters = "(){}#,+-*/%^ \n\t\"<>0e9.~_aR\x01\xff";
  Random random(1);
  for (int round = 0; round < 3000; ++round) {
    std::string text = whole;
    for (int edit = 0; edit < 3; ++edit) {
      text[random.below(text.size())] = letters[random.below(letters.size())];
    }
    rayshade_refusal(text);
  }
}

}  // namespace
}  // namespace isolux
