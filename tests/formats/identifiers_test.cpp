#include "isolux/formats/identifiers.h"

#include <gtest/gtest.h>

namespace isolux {
namespace {

TEST(Identifiers, ANameBecomesOneWord) {
  EXPECT_EQ(identifier("wall"), "wall");
  EXPECT_EQ(identifier("south wall.2-b"), "south_wall.2-b");
  EXPECT_EQ(identifier("!rm"), "x_rm");
  EXPECT_EQ(identifier("2nd"), "x2nd");
  EXPECT_EQ(identifier("a\nb#c"), "a_b_c");
  EXPECT_EQ(identifier(""), "x");
  EXPECT_LE(identifier(std::string(10'000, 'a')).size(), 100u);
}

TEST(Identifiers, EachIsGivenOnce) {
  Identifiers names({"void"});
  EXPECT_EQ(names.next("a b"), "a_b");
  EXPECT_EQ(names.next("a_b"), "a_b_2");
  EXPECT_EQ(names.next("a b"), "a_b_3");
  EXPECT_EQ(names.next("a_b_3"), "a_b_3_2");
  EXPECT_EQ(names.next("void"), "void_2");
}

}  // namespace
}  // namespace isolux
