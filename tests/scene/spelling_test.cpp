#include "isolux/scene/spelling.h"

#include <gtest/gtest.h>

namespace isolux {
namespace {

TEST(Spelling, NearestName) {
  const std::vector<std::string_view> keys = {"center", "radius", "reflectance"};
  EXPECT_EQ(nearest_name("raduis", keys), "radius");
  EXPECT_EQ(nearest_name("Centre", keys), "center");
  EXPECT_EQ(nearest_name("reflektance", keys), "reflectance");
  EXPECT_EQ(nearest_name("emission", keys), std::nullopt);
  EXPECT_EQ(nearest_name("", keys), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(100'000, 'a'), keys), std::nullopt);
  EXPECT_EQ(nearest_name("x", {"y"}), std::nullopt);
}

TEST(Spelling, SuggestionNamesTheNearestOrAll) {
  EXPECT_EQ(suggestion("cn", {"m", "cm"}), "did you mean 'cm'?");
  EXPECT_EQ(suggestion("parsec", {"m", "cm", "mm"}), "use one of 'm', 'cm' and 'mm'");
  EXPECT_EQ(suggestion("white", {}), "there are none");
}

TEST(Spelling, QuotesStayOnOneLine) {
  EXPECT_EQ(in_quotes("a\nb\x01"), "'a b '");
  EXPECT_LT(in_quotes(std::string(1000, 'x')).size(), 100u);
  // Cut between characters, not within one.
  std::string umlauts = "x";
  for (int i = 0; i < 100; ++i) umlauts += "\u00e4";
  EXPECT_EQ(in_quotes(umlauts).substr(0, 3), "'x\xc3");
  EXPECT_EQ(in_quotes(umlauts).find("\xc3."), std::string::npos);
}

}  // namespace
}  // namespace isolux
