#include "isolux/image/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace isolux {
namespace {

/// 1000 pixels of luminances from 1 to about 1000 cd/m², the last five a lamp of 10⁵.
Picture room_with_lamp(double scale) {
  Picture picture(1000, 1);
  for (int x = 0; x < 1000; ++x) {
    picture.at(x, 0) = gray(scale * (x < 995 ? std::pow(1000, x / 1000.0) : 1e5));
  }
  return picture;
}

TEST(ToneMap, KeepsTheOrderAndSaturatesTheLampAlone) {
  const Picture shown = tone_map(room_with_lamp(1));
  for (int x = 1; x < 1000; ++x) EXPECT_GE(shown.at(x, 0).r, shown.at(x - 1, 0).r);
  EXPECT_EQ(shown.at(999, 0), gray(1));
  EXPECT_LT(shown.at(970, 0).r, 0.98);
  EXPECT_NEAR(shown.at(490, 0).r, 0.27, 0.03) << "the middle of the room is a middle grey";
}

TEST(ToneMap, IsIndifferentToTheUnit) {
  const Picture a = tone_map(room_with_lamp(1)), b = tone_map(room_with_lamp(1e-7));
  for (int x = 0; x < 1000; ++x) EXPECT_NEAR(a.at(x, 0).g, b.at(x, 0).g, 1e-9);
}

TEST(ToneMap, KeepsHue) {
  Picture picture(2, 1);
  picture.at(0, 0) = {1, 2, 3};
  picture.at(1, 0) = {10, 10, 10};
  const Rgb c = tone_map(picture).at(0, 0);
  EXPECT_NEAR(c.g / c.r, 2, 1e-12);
  EXPECT_NEAR(c.b / c.r, 3, 1e-12);
}

TEST(ToneMap, NothingComesOutOfRange) {
  EXPECT_EQ(tone_map(Picture(2, 2)).pixels, Picture(2, 2).pixels);
  EXPECT_TRUE(tone_map(Picture()).pixels.empty());
  Picture odd(5, 1);
  odd.pixels = {gray(std::nan("")), gray(INFINITY), gray(-1), gray(1e300), gray(1e-300)};
  for (const Rgb& c : tone_map(odd).pixels) {
    EXPECT_GE(min_channel(c), 0);
    EXPECT_LE(max_channel(c), 1);
  }
}

}  // namespace
}  // namespace isolux
