#include <gmock/gmock.h>

#include "formats/mgf_text.h"
#include "isolux/core/random.h"

namespace isolux {
namespace {
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(MgfError, GivesTheExactPlaceAndOneLine) {
  // Each text stands behind those of kVertices, 10 lines.
  const std::pair<const char*, const char*> cases[] = {
      {"sph nowhere 1", "11:5: 'nowhere' is not defined: use one of 'o', 'x', 'xy', 'y' and 'z'"},
      {"sph o", "11:1: 'sph' lacks an argument: write sph center radius"},
      {"sph o 1 2", "11:9: '2' is one argument too many: write sph center radius"},
      {"sph o 1m", "11:7: expected a number, not '1m'"},
      {"sph o 1e999", "11:7: '1e999' is not a finite number"},
      {"sph o .nan", "11:7: '.nan' is not a finite number"},
      {"sph o 1e13", "11:1: radius: must be a length between 1e-12 and 1e+12 m"},
      {"\n  f o x \\\n\t nowhere", "13:3: 'nowhere' is not defined"},
      {"p 1 -1e13 0", "11:5: must lie between -1e+12 and 1e+12"},
      {"xf -s 1e20\nf o x y\nxf", "12:1: vertex: coordinates must be finite numbers"},
      {"c a b", "11:5: expected '=', not 'b'"},
      {"m a = a a", "11:9: 'a' is one argument too many"},
      {"f o x", "11:1: 'f' lacks an argument"},
      {"v p =\np 3 1 0\nv q =\np 0 2 0\nf o p x q",
       "15:1: points: the sides that start at corners"},
      {"fh o x y - x y", "11:14: a contour has at least 3 vertices"},
      {"ring o 0 1", "11:6: the vertex needs a normal (n)"},
      {"ring z 2 1", "11:8: the inner radius must be less than the outer one"},
      {"ring z -1 1", "11:8: must not be negative, but is -1"},
      {"torus z 1 -2", "11:9: the radii of a torus must have the same sign"},
      {"cone o 1 z -1", "11:12: the radii of a cone must have the same sign"},
      {"prism o x y z", "11:13: expected a number, not 'z'"},
      {"rd -0.1", "11:4: must not be negative"},
      {"rs 0.1", "11:1: 'rs' lacks an argument: write a fraction and a roughness"},
      {"ed 1e13", "11:4: must be at most 1e+12 lm/m²"},
      {"sides 3", "11:7: expected a whole number from 1 to 2, not '3'"},
      {"cxy 0.3 0", "11:9: y must be more than 0"},
      {"cxy 0.7 0.7", "11:5: x + y must be at most 1, but is 1.4"},
      {"cspec 700 400 1 1", "11:11: the last wavelength must be longer than the first"},
      {"cspec 400 700 1", "11:1: 'cspec' lacks an argument"},
      {"cct -5", "11:5: the temperature must lie between 100 and 1000000 K, but is -5"},
      {"cmix 1 red", "11:8: 'red' is not defined: there are none"},
      {"c red =\nc\ncmix 1 red 2", "13:12: this weight lacks a color"},
      {"c red =\nc\ncmix -1 red", "13:6: the weights must have a positive sum"},
      {"m red = blue", "11:9: 'blue' is not defined: there are none"},
      {"m red : blue", "11:7: expected '=', not ':'"},
      {"v xx", "11:3: 'xx' is not defined: did you mean"},
      {"o", "11:1: no object is open in this file"},
      {"xf", "11:1: no transform is open in this file"},
      {"\txf -t 1 0 0", "11:2: this transform is not ended in its file"},
      {"xf -t 1 0", "11:4: '-t' needs 3 numbers"},
      {"xf -q 1", "11:4: unknown transform '-q'"},
      {"xf -s 0", "11:7: a factor of 0 flattens everything"},
      {"xf -s 1e-200", "11:1: the transform has numbers too large or too small"},
      {"xf -a", "11:4: '-a' needs a count"},
      {"xf -a 0 -t 1 0 0", "11:7: expected a whole number from 1 to 1000000, not '0'"},
      {"xf -a 2.5 -t 1 0 0", "11:7: expected a whole number"},
      {"xf -a 10000 -t 1 0 0 -a 10000 -t 0 1 0", "11:22: the arrays of this scene have too many"},
      {"i /etc/passwd", "11:3: '/etc/passwd' can't be included"},
      {"i no/such.mgf", "11:3: there is no file 'no/such.mgf'"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string message = mgf_refusal(kVertices + text + "\n");
    EXPECT_THAT(message, StartsWith(std::string("test.mgf:") + expected)) << text;
    EXPECT_THAT(message, testing::Not(HasSubstr("\n")));
    EXPECT_LT(message.size(), 300u);
  }
}

TEST(MgfError, ASceneWithoutSurfaces) {
  EXPECT_EQ(mgf_refusal(""), "test.mgf:1:1: the scene has no surfaces");
  EXPECT_EQ(mgf_refusal(kVertices + "sph o 0\n"), "test.mgf:1:1: the scene has no surfaces");
}

TEST(MgfError, HugeCountsAreRefused) {
  EXPECT_THAT(mgf_refusal(kVertices + "xf -a 501 -t 1 0 0 -a 500 -t 0 1 0\nsph o 1\nxf\n"),
              EndsWith("the scene has more than 250000 surfaces"));
  const std::string array = "xf -a 1000 -t 1 0 0 -a 1000 -t 0 1 0\nxf\n";
  EXPECT_THAT(mgf_refusal(kVertices + array + array + array), HasSubstr("too many instances"));
  std::string nest = kVertices;
  for (int i = 0; i < 100'000; ++i) nest += "o deep\n";
  EXPECT_THAT(mgf_refusal(nest), StartsWith("test.mgf:43:1: objects (o) nest more than 32 deep"));
  std::string face = kVertices + "xf -a 1000 -t 1 0 0\nf";
  for (int i = 0; i < 999; ++i) face += " x y";
  EXPECT_THAT(mgf_refusal(face + "\nxf\n"), HasSubstr("at most 1000 corners"));
}

// Whatever is cut off or flipped: a scene or one InputError, nothing else.
TEST(MgfError, MutilatedTextsEndInASceneOrAnInputError) {
  const std::string whole =
      kVertices +
      "c red =\ncxy 0.6 0.3\nc s =\ncspec 400 700 1 2 3\ncct 3000\ncmix 1 red 2 s\n"
      "m a =\nsides 1\nrd 0.5\ned 3\nrs 0.1 0.2\no top\nxf -a 3 -t 1 0 0 -rx 30 -i 2 -s 0.5\n"
      "f o x xy y\nfh o x y - o xy y\nsph x -1\ncyl o 1 z\ncone o 1 z 0\nring z 0 1\n"
      "torus z 1 2\nprism o x y 1\nxf\no\n";
  for (std::size_t size = 0; size < whole.size(); ++size) mgf_refusal(whole.substr(0, size));
  const std::string letters = "-+.019eaxyzof \n\r\t\\#=\x01\xff";
  Random random(1);
  for (int round = 0; round < 3000; ++round) {
    std::string text = whole;
    for (int edit = 0; edit < 3; ++edit) {
      text[random.below(text.size())] = letters[random.below(letters.size())];
    }
    mgf_refusal(text);
  }
}

}  // namespace
}  // namespace isolux
