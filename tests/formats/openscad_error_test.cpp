// Malformed models: each ends in one line with its place; none in a crash or a hang.
#include <gmock/gmock.h>

#include "formats/openscad_text.h"
#include "isolux/core/random.h"

namespace isolux {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(OpenScadErrors, NameTheirPlaceAndTheMend) {
  struct Case {
    std::string text, place, phrase;
  };
  const Case cases[] = {
      {"", "1:1: ", "the model is empty"},
      {"group() {\n  cube(size = 1)\n}", "3:1: ", "expected ';' or '{'"},
      {"union() {\n cube(size = 1);", "1:1: ", "'union' has no end"},
      {"cube(size = 1", "1:14: ", "the file ends where ',' or ')' should be"},
      {"cube(size = [1, 2, 3);", "1:21: ", "',' or ']'"},
      {"cube(size = [1, 2]);", "1:13: ", "a list of 3 or more"},
      {"cube(size = \"big\");", "1:13: ", "'size' must be a list"},
      {"cube();", "1:1: ", "needs 'size'"},
      {"cube(size = 1, center = 3);", "1:25: ", "true or false"},
      {"cube(size = nan);", "1:13: ", "numbers are finite"},
      {"cube(size = 1e999);", "1:13: ", "too large"},
      {"cube(size = 1e12);", "1:13: ", "within 1e+09"},
      {"cube(size = 1.2.3);", "1:13: ", "no finite number"},
      {"cube(size = --1);", "1:13: ", "no finite number"},
      {"cub(size = 1);", "1:1: ", "did you mean 'cube'?"},
      {"\n\n  5;", "3:3: ", "expected a name"},
      {"sphere(r = 1); /* no end", "1:16: ", "this comment does not end"},
      {"text(text = \"no end);", "1:13: ", "this text does not end"},
      {"multmatrix() { cube(size = 1); }", "1:1: ", "four rows of four"},
      {"multmatrix([[1, 0, 0], [0, 1, 0], [0, 0, 1]]) { cube(size = 1); }",
       "1:13: ", "four rows of four"},
      {"multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]) { cube(size = 1); }",
       "1:55: ", "the last 0, 0, 0, 1"},
      {"color([2, 0, 0]) { cube(size = 1); }", "1:8: ", "from 0 to 1"},
      {"color(\"red\") { cube(size = 1); }", "1:7: ", "'color' must be a list"},
      {"polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces = [[0, 1, 3]]);",
       "1:72: ", "there is no point 3: they count from 0 to 2"},
      {"difference() {\n cube(size = 1);\n polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "
       "faces = [[0, 1, 2]]);\n}",
       "1:1: ", "closed solids only"},
      {"linear_extrude(height = 1) {\n polygon(points = [[0, 0], [2, 2], [2, 0], [0, 1]]); }",
       "2:2: ", "'polygon' can't be made: points"},
      {"linear_extrude(height = 1) { cube(size = 1); }", "1:1: ", "the model is empty"},
      {"linear_extrude(height = 1) { sqare(size = 1); }", "1:30: ", "did you mean 'square'?"},
      {"linear_extrude() { square(size = 1); }", "1:1: ", "needs 'height'"},
      {"linear_extrude(height = 1, twist = 1e6) { square(size = 1); }", "1:43: ", "twist"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const std::string refusal = model_refusal(c.text);
    EXPECT_THAT(refusal, StartsWith("test.csg:" + c.place));
    EXPECT_THAT(refusal, HasSubstr(c.phrase));
    EXPECT_THAT(refusal, testing::Not(HasSubstr("\n")));
  }
}

TEST(OpenScadErrors, TheFileBesideIsReadStrictly) {
  struct Case {
    std::string lights, place, phrase;
  };
  const Case cases[] = {
      {"light: []", "1:1: ", "did you mean 'lights'?"},
      {"unit: furlong", "1:7: ", "furlong"},
      {"materials: {a: {color: red}}", "1:24: ", "\"#rrggbb\""},
      {"materials: {a: {color: [0, 0, 2]}}", "1:24: ", "from 0 to 1"},
      {"materials: {a: {color: \"#ff0000\"}, b: {color: [1, 0, 0]}}",
       "1:36: ", "a second material"},
      {"materials: {a: {reflectance: 1}}", "1:30: ", "less than 1"},
      {"cameras: {a: {eye: [0, 0, 0], look_at: [0, 0, 0]}}", "1:40: ", "must differ"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.lights);
    const std::string refusal = model_refusal("cube(size = 1);", c.lights);
    EXPECT_THAT(refusal, StartsWith("test.lights.yaml:" + c.place));
    EXPECT_THAT(refusal, HasSubstr(c.phrase));
  }
}

TEST(OpenScadErrors, DepthHasItsLimits) {
  const auto nested = [](const std::string& opening, int times, const std::string& innermost) {
    std::string text;
    for (int i = 0; i < times; ++i) text += opening;
    return text + innermost + std::string(static_cast<std::size_t>(times), '}');
  };
  EXPECT_THAT(model_refusal(nested("group(){", 100'000, "")),
              HasSubstr("nodes inside one another"));
  EXPECT_THAT(model_refusal("cube(size=" + std::string(100'000, '[')),
              HasSubstr("lists inside one another"));
  EXPECT_EQ(model_refusal(nested("group(){", 150, "cube(size=1);")), "");
  const std::string cut = "difference(){cube(size=1);";
  EXPECT_EQ(model_refusal(nested(cut, 30, "cube(size=1);")), "");
  EXPECT_THAT(model_refusal(nested(cut, 60, "cube(size=1);")), HasSubstr("more than 40 deep"));
}

// Whatever is cut off or flipped: a scene or one InputError, nothing else.
TEST(OpenScadErrors, MutilatedModelsEndInASceneOrAnInputError) {
  const std::string folder = ISOLUX_SOURCE_DIR "/tests/formats/openscad/";
  const std::string letters = "{}()[],;=%#\"/*-.e019 \n\t\x01\xff";
  Random random(1);
  for (const char* name : {"flange.csg", "vessels.csg", "die.csg"}) {
    const std::string whole = read_file(folder + name);
    for (std::size_t size = 0; size < whole.size(); size += 41) {
      model_refusal(whole.substr(0, size));
    }
    for (int round = 0; round < 500; ++round) {
      std::string text = whole;
      for (int edit = 0; edit < 2; ++edit) {
        text[random.below(text.size())] = letters[random.below(letters.size())];
      }
      model_refusal(text);
    }
  }
}

}  // namespace
}  // namespace isolux
