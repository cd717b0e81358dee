#include <fmt/format.h>
#include <gmock/gmock.h>

#include "formats/radiance_text.h"
#include "formats/temporary_folder.h"
#include "isolux/core/random.h"

namespace isolux {
namespace {
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(RadianceError, GivesTheExactPlaceAndOneLine) {
  // Each text stands behind kGray, 5 lines.
  const std::pair<const char*, const char*> cases[] = {
      {"m", "6:1: the file ends after 'm': a primitive begins with its modifier, type and name"},
      {"m sphere", "6:3: the file ends after 'sphere'"},
      {"m sphere s", "6:10: the file ends after 's': a primitive has three lists of arguments"},
      {"m sphere s 0 0", "6:10: the file ends after 's'"},
      {"m sphere s x 0 4", "6:12: expected a number, not 'x'"},
      {"m sphere s -1 0 4", "6:12: expected how many words follow, from 0 to 1000000, not '-1'"},
      {"m sphere s 0 1.5 4", "6:14: expected how many whole numbers follow"},
      {"m sphere s 0 0 9999999 1", "6:16: expected how many numbers follow"},
      {"m sphere s 0 0 4 1 2 3", "6:16: of these 4 numbers, there are only 3 before the end"},
      {"m sphere s 0 0 3 1 2 3", "6:16: 'sphere' takes other numbers than these 3: x y z radius"},
      {"m sphere s 0 0 4 1 2 3\n  1m", "7:3: expected a number, not '1m'"},
      {"m sphere s 0 0 4 1 2 3 1e999", "6:24: '1e999' is not a finite number"},
      {"m sphere s 0 0 4 1 2 3 .nan", "6:24: '.nan' is not a finite number"},
      {"m sphere s 0 0 4 1 2 3 1e13", "6:1: radius: must be a length between"},
      {"m sphre s 0 0 4 1 2 3 1", "6:3: unknown type 'sphre': did you mean 'sphere'?"},
      {"m polygon p 0 0 6 0 0 0 1 1 1", "6:17: a polygon has three numbers for each corner"},
      {"m polygon p 0 0 10 0 0 0 1 0 0 1 1 0 2", "6:17: a polygon has three numbers"},
      {"m polygon p 0 0 12 0 0 0 3 1 0 3 0 0 0 2 0", "6:1: points: the sides"},
      {"m cone c 0 0 8 0 0 0 0 0 1 1 -1", "6:30: the radii of a cone must have the same sign"},
      {"m ring r 0 0 8 0 0 0 0 0 0 0 1", "6:22: the direction of a ring must not be zero"},
      {"m ring r 0 0 8 0 0 0 0 0 1 -1 1", "6:28: the radius of a ring must not be negative"},
      {"m source s 0 0 4 0 0 0 1", "6:18: the direction must not be zero"},
      {"m source s 0 0 4 0 0 1 400", "6:24: the angle must lie between 0 and 360 degrees"},
      {"m instance i 0 0 0", "6:14: an instance has the name of an octree"},
      {"m instance i 3 a.oct -q 1 0 0", "6:22: unknown transform '-q'"},
      {"void plastic p 0 0 3 1 1 1", "6:20: 'plastic' takes other numbers than these 3"},
      {"void plastic p 0 0 5 .5 -1 0 0 0", "6:25: a color must not be negative"},
      {"void plastic p 0 0 5 .5 1 0 2 0", "6:29: must lie between 0 and 1, but is 2"},
      {"void light l 0 0 3 1e12 1 1", "6:20: more than 1e+12 lm/m² would leave this light"},
      {"void mixfunc x 1 m 0 0", "6:16: a mixture has two modifiers"},
      {"void alias a", "6:12: the file ends after 'a': an alias needs a name to stand for"},
      {"m sphere \"ball 0 0 4", "6:10: this quote is not closed"},
      {"!", "6:2: a program must stand here"},
      {"!genbox m b 1 1 1 | | xform", "6:21: a program must stand here"},
      {"!genbox m b 1 1", "6:2: 'genbox' lacks an argument: write genbox modifier name x y z"},
      {"!genbox m b 1 0 1", "6:15: must be more than 0, but is 0"},
      {"!genbox m b 1 1 1 -r", "6:19: '-r' needs a number"},
      {"!genbox m b 1 1 1 -b .6", "6:22: the edges take more than the whole box"},
      {"!genprism m p 2 0 0 1 1", "6:15: expected a whole number from 3 to 1000, not '2'"},
      {"!genprism m p 3 0 0 1 1", "6:2: 'genprism' lacks an argument"},
      {"!genprism m p 3 0 0 1 0 0 1 -l 0 0 0", "6:36: the prism needs a height"},
      {"!genprism m p 3 0 0 1 0 0 1 -r 2", "6:2: the edges of the prism are rounder"},
      {"!genprism m p corners", "6:15: there is no file 'corners'"},
      {"!genblinds m b 1 1 1 0 0", "6:22: expected a whole number from 1 to 10000, not '0'"},
      {"!genrev m r t 1 0", "6:17: expected a whole number from 1 to 250000, not '0'"},
      {"!genrev m r t -1 4", "6:15: the radius must not be negative"},
      {"!genrev m r '2*(t' 1 4", "6:14: '': ')' must stand here"},
      {"!genrev m r '2**t' 1 4", "6:14: '*t': a number or a name must stand here"},
      {"!genrev m r t+ 1 4", "6:13: '': a number or a name must stand here"},
      {"!genrev m r 1/0 1 4", "6:13: '1/0' comes to no finite number"},
      {"!gensurf m r s t 1 1000 1001", "6:20: the surface has more than 1000000 triangles"},
      {"!xform -t 1 0 0", "6:2: here this program needs the name of a file"},
      {"!xform -t 1 0 0 no-such", "6:17: there is no file 'no-such'"},
      {"!xform /etc/passwd", "6:8: '/etc/passwd' can't be included"},
      {"!xform ../../etc/passwd", "6:8: '../../etc/passwd' lies outside the folder of the scene"},
      {"!genbox m b 1 1 1 | xform -t 1", "6:27: '-t' needs 3 numbers"},
      {"!genbox m b 1 1 1 | xform -s 0", "6:30: a factor of 0 flattens everything"},
      {"!genbox m b 1 1 1 | xform -n", "6:27: '-n' needs a name"},
      {"!genbox m b 1 1 1 | xform file", "6:27: here xform reads the output of the program before"},
      {"# comment\n\t!genbox m b 1 \\\n\t 1 x", "8:5: expected a number, not 'x'"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string message = radiance_refusal(std::string(text) + "\n");
    EXPECT_THAT(message, StartsWith(std::string("test.rad:") + expected)) << text;
    EXPECT_THAT(message, testing::Not(HasSubstr("\n")));
    EXPECT_LT(message.size(), 300u);
  }
}

TEST(RadianceError, WordsAreNotTooLong) {
  EXPECT_EQ(radiance_refusal("m sphere " + std::string(4001, 'x') + " 0 0 4 0 0 0 1"),
            "test.rad:6:10: a word has at most 4000 characters");
}

TEST(RadianceError, LinesEndInAnyWay) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    EXPECT_THAT(radiance_refusal("# comment" + end + "m sphere s" + end + "0" + end + "x"),
                StartsWith("test.rad:9:1: expected a number"));
  }
}

TEST(RadianceError, ASceneWithoutSurfaces) {
  EXPECT_EQ(radiance_refusal(""), "test.rad:1:1: the scene has no surfaces");
  EXPECT_THAT(radiance_refusal("void sphere s 0 0 4 0 0 0 1\n"),
              StartsWith("test.rad:1:1: none of the scene's 1 surfaces reflects or shines"));
}

TEST(RadianceError, HugeCountsAreRefused) {
  EXPECT_THAT(radiance_refusal("!genbox m b 1 1 1 | xform -a 1000 -t 2 0 0 -a 1000 -t 0 2 0\n"),
              EndsWith("the scene has more than 250000 surfaces"));
  EXPECT_THAT(
      radiance_refusal("!genbox m b 1 1 1 | xform -a 100000 -t 2 0 0 | xform -a 100 -t 0 2 0\n"),
      HasSubstr("too many instances"));
  const std::string sheet = "!gensurf m s s t 0 700 700\n";
  EXPECT_THAT(radiance_refusal(sheet + sheet),
              EndsWith("the meshes of this scene have more than 1000000 triangles"));
  std::string expression = "t";
  for (int i = 0; i < 1000; ++i) expression += "+t";
  EXPECT_THAT(radiance_refusal("!genrev m r " + expression + " 1 250000\n"),
              EndsWith("the expressions of this scene take too long for so many points"));
  EXPECT_THAT(radiance_refusal("!genrev m r '" + std::string(3000, '(') + "' 1 1\n"),
              HasSubstr("nested too deep"));
  std::string polygon = "m polygon p 0 0 3000";
  for (int i = 0; i < 1000; ++i) {
    polygon += fmt::format(" {} {} 0", std::cos(i * 0.00628), std::sin(i * 0.00628));
  }
  const TemporaryFolder folder;
  folder.write("p", kGray + polygon + "\n");
  try {
    read_radiance(folder.write("main.rad", "!xform -a 1000 -t 0 0 1 p\n"));
    ADD_FAILURE() << "too many corners are read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("too many corners"));
  }
}

TEST(RadianceError, FilesThatReadThemselves) {
  const TemporaryFolder folder;
  folder.write("a", "!xform b\n");
  folder.write("b", "!xform a\n");
  // Each file reads the next twice.
  for (int i = 0; i < 20; ++i) {
    folder.write(fmt::format("d{}", i), fmt::format("!xform d{0}\n!xform d{0}\n", i + 1));
  }
  folder.write("d20", kGray + "m sphere s 0 0 4 0 0 0 1\n");
  const std::pair<std::string, std::string> cases[] = {
      {"!xform a\n", "'a' includes itself"},
      {"!xform main.rad\n", "'main.rad' includes itself"},
      {"!xform d0\n", "more than 1000 files are included"}};
  for (const auto& [text, expected] : cases) {
    try {
      read_radiance(folder.write("main.rad", text));
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(expected));
    }
  }
}

// Whatever is cut off or flipped: a scene or one InputError, nothing else.
TEST(RadianceError, MutilatedTextsEndInASceneOrAnInputError) {
  const std::string whole =
      kGray +
      "void brightfunc p 2 f . 0 1 2\np metal a 0 0 5 .5 .4 .3 .1 0\nvoid alias b a\n"
      "void trans t 0 0 7 .5 .4 .3 .1 0 .2 .1\nvoid mixfunc x 4 a b f . 0 0\n"
      "void light l 0 0 3 1 2 3\nvoid glow g 0 0 4 1 1 1 0\n"
      "l source sun 0 0 4 0 0 1 .5\nx sphere s 0 0 4 0 0 0 1\nt bubble u 0 0 4 0 0 0 1\n"
      "a cone c 0 0 8 0 0 0 0 0 1 1 2\ng tube d 0 0 7 0 0 0 0 0 1 1\n"
      "b ring r 0 0 8 0 0 0 0 0 1 1 2\nl polygon q 0 0 12 0 0 0 1 0 0 1 1 0 0 1 0\n"
      "!genbox m b 1 1 1 -r .1 | xform -n a -a 2 -t 1 0 0 -rx 30\n"
      "!genprism m p 3 0 0 1 0 0 1 -l 0 1 2 -r .1 | xform -m a -mx -s 2\n"
      "!genrev m r 'hermite(0,1,t,2,t)' \"1+.5*sin(PI*t)\" 3 -s\n"
      "!genworm m w t '-t^2' 0 .1 2\n!gensurf m f s t 's*t/(1+t)' 2 2\n"
      "!genblinds m v 1 2 3 4 30 -r 2\n"
      "!gensky 6 21 13:30EDT +i -b 10 -g .2 -a 42 | xform -rz 20\n"
      "skyfunc glow y 0 0 4 1 1 1 0\ny source s 0 0 4 0 0 1 360\n"
      "void brightfunc k 2 skybright perezlum.cal 0 10 2 3 -1 -.3 9 -3 .4 0 -.6 .8\n"
      "k glow z 0 0 4 1 1 1 0\nz source s 0 0 4 0 0 -1 180\n";
  for (std::size_t size = 0; size < whole.size(); ++size) radiance_refusal(whole.substr(0, size));
  const std::string letters = "-+.0139eamtxyz'\"|!# \n\r\t\\()*^/\x01\xff";
  Random random(1);
  for (int round = 0; round < 3000; ++round) {
    std::string text = whole;
    for (int edit = 0; edit < 3; ++edit) {
      text[random.below(text.size())] = letters[random.below(letters.size())];
    }
    radiance_refusal(text);
  }
}

}  // namespace
}  // namespace isolux
