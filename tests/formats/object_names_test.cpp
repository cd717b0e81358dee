#include "isolux/formats/object_names.h"

#include <gtest/gtest.h>

namespace isolux {
namespace {

TEST(ObjectNames, AreShortAndPrintable) {
  EXPECT_EQ(clean_name("desk.leg"), "desk.leg");
  EXPECT_EQ(clean_name("a\tb\xff"), "a?b?");
  EXPECT_EQ(clean_name(std::string(1000, 'x')), std::string(60, 'x'));
  EXPECT_EQ(clean_name("", "unnamed"), "unnamed");
}

TEST(ObjectNames, AreNumberedWhereTheyRepeat) {
  NumberedNames names;
  EXPECT_EQ(names.next("wall"), "wall");
  EXPECT_EQ(names.next("door"), "door");
  EXPECT_EQ(names.next("wall"), "wall 2");
  EXPECT_EQ(names.next("wall"), "wall 3");
}

TEST(ObjectNames, AreTakenWhereAFileNumbersThemItself) {
  NumberedNames names;
  EXPECT_EQ(names.next("wall 2"), "wall 2");
  EXPECT_EQ(names.next("wall"), "wall");
  EXPECT_EQ(names.next("wall"), "wall 3");
  EXPECT_EQ(names.next("wall 2"), "wall 2 2");
}

}  // namespace
}  // namespace isolux
