#include "isolux/core/color.h"

#include <gtest/gtest.h>

#include <limits>

namespace isolux {
namespace {

TEST(Color, EqualChannelsCarryTheirOwnLuminance) {
  EXPECT_NEAR(luminance(gray(123.0)), 123.0, 1e-12);
}

TEST(Color, LuminanceWeighsByRec709) {
  EXPECT_GT(luminance({0, 1, 0}), luminance({1, 0, 0}));
  EXPECT_GT(luminance({1, 0, 0}), luminance({0, 0, 1}));
}

TEST(Color, ChannelsAreIndependent) {
  const Rgb c = Rgb{1, 2, 3} * Rgb{4, 5, 6} - gray(1) * 2;
  EXPECT_EQ(c, (Rgb{2, 8, 16}));
  EXPECT_EQ(max_channel(c), 16);
  EXPECT_EQ(min_channel(c), 2);
}

TEST(Color, OneBadChannelIsNotFinite) {
  EXPECT_TRUE(is_finite(gray(0)));
  EXPECT_FALSE(is_finite(Rgb{0, std::numeric_limits<double>::infinity(), 0}));
  EXPECT_FALSE(is_finite(Rgb{0, 0, std::numeric_limits<double>::quiet_NaN()}));
}

}  // namespace
}  // namespace isolux
