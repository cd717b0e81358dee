#include <gmock/gmock.h>

#include <filesystem>

#include "isolux/core/file.h"
#include "isolux/core/random.h"
#include "scene/scene_text.h"

namespace isolux {
namespace {
namespace fs = std::filesystem;

const fs::path kFolder = fs::path(ISOLUX_SOURCE_DIR) / "tests/scene/bad";

// Each file's first line says what to expect: "# expect LINE:COLUMN PHRASE".
TEST(BadScene, IsRefusedInOneLineWithItsPlaceAndTheMend) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    SCOPED_TRACE(entry.path().filename().string());
    const std::string text = read_file(entry.path());
    const std::string expectation = text.substr(0, text.find('\n'));
    ASSERT_THAT(expectation, testing::StartsWith("# expect "));
    const std::size_t place = 9, phrase = expectation.find(' ', place) + 1;
    try {
      load_scene(entry.path());
      ADD_FAILURE() << "was accepted";
    } catch (const InputError& error) {
      const std::string message = error.what();
      const std::string start =
          entry.path().string() + ':' + expectation.substr(place, phrase - 1 - place) + ": ";
      EXPECT_THAT(message, testing::StartsWith(start));
      EXPECT_THAT(message, testing::HasSubstr(expectation.substr(phrase)));
      EXPECT_THAT(message, testing::Not(testing::HasSubstr("\n")));
      EXPECT_LT(message.size(), start.size() + 300);
    }
    ++count;
  }
  EXPECT_GE(count, 24);
}

TEST(BadScene, MissingOrUnreadableFile) {
  EXPECT_THROW(load_scene("no such scene.yaml"), InputError);
  EXPECT_THROW(load_scene(kFolder), InputError);
}

TEST(BadScene, RecursiveAliasIsRefused) {
  EXPECT_THAT(refusal("isolux: 1\nname: &a [*a]\n"),
              testing::HasSubstr("an alias can't stand inside what it names"));
}

TEST(BadScene, DeepNestingOfAnyKindIsRefused) {
  for (const std::string opening : {"[", "{a: ", "- ", "? ", "[{a: "}) {
    std::string text = "isolux: 1\nname: ";
    if (opening == "- " || opening == "? ") text += '\n';
    for (int i = 0; i < 100'000; ++i) text += opening;
    EXPECT_NE(refusal(text), "") << opening;
  }
}

// Whatever is cut off or flipped: a scene or one InputError, nothing else.
TEST(BadScene, MutilatedScenesEndInASceneOrAnInputError) {
  const std::string whole =
      read_file(fs::path(ISOLUX_SOURCE_DIR) / "examples/lalonde1993/room.yaml");
  for (std::size_t size = 0; size < whole.size(); size += 7) refusal(whole.substr(0, size));
  const std::string letters = "{}[]:,-&*!|>'\"%@` \n\t#?0e.~\x01\xff";
  Random random(1);
  for (int round = 0; round < 2000; ++round) {
    std::string text = whole;
    for (int edit = 0; edit < 3; ++edit) {
      text[random.below(text.size())] = letters[random.below(letters.size())];
    }
    refusal(text);
  }
}

}  // namespace
}  // namespace isolux
