#include "isolux/formats/notes.h"

#include <gmock/gmock.h>

#include <string>

namespace isolux {
namespace {
using testing::ElementsAre;

TEST(Notes, EachThingIsToldOnce) {
  Notes notes;
  notes.add("a line");
  notes.left_out("fog", "clear air");
  notes.changed("mirror", "it is black");
  notes.left_out("mist", "clear air");
  notes.left_out("fog", "clear air");
  notes.add("a line");
  EXPECT_THAT(notes.lines(), ElementsAre("'fog' and 'mist' left out: clear air",
                                         "'mirror': it is black", "a line"));
}

TEST(Notes, TheirNumberIsBounded) {
  Notes notes;
  for (int i = 0; i < 1000; ++i) notes.add(std::to_string(i));
  EXPECT_EQ(notes.lines().size(), 100u);
}

}  // namespace
}  // namespace isolux
