#include "isolux/image/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>

#include "isolux/core/error.h"
#include "solution/small_solution.h"

namespace isolux {
namespace {

TEST(Png, CodesAreThoseOfSrgb) {
  EXPECT_EQ(srgb_code(0), 0);
  EXPECT_EQ(srgb_code(-1), 0);
  EXPECT_EQ(srgb_code(std::nan("")), 0);
  EXPECT_EQ(srgb_code(1), 255);
  EXPECT_EQ(srgb_code(INFINITY), 255);
  // Two known points of IEC 61966-2-1: the middle code, and the end of the straight piece.
  EXPECT_EQ(srgb_code(0.21586), 128);
  EXPECT_EQ(srgb_code(0.0031308), 10);
  for (int code = 0; code < 256; ++code) {
    const double v = code / 255.0;
    const double linear = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    EXPECT_EQ(srgb_code(linear), code);
  }
}

TEST(Png, CanBeReadBack) {
  const TemporaryFolder folder;
  Picture picture(2, 3);
  picture.at(1, 0) = {1, 0, 0};
  picture.at(0, 2) = {0, 0.21586, 5};
  write_png(picture, folder / "a.png");

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&image, (folder / "a.png").c_str()));
  EXPECT_EQ(image.width, 2u);
  EXPECT_EQ(image.height, 3u);
  EXPECT_EQ(image.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
  std::vector<png_byte> codes(PNG_IMAGE_SIZE(image));
  ASSERT_TRUE(png_image_finish_read(&image, nullptr, codes.data(), 0, nullptr));
  const std::vector<png_byte> expected = {0, 0, 0, 255, 0,   0,   0, 0, 0,
                                          0, 0, 0, 0,   128, 255, 0, 0, 0};
  EXPECT_EQ(codes, expected);
}

TEST(Png, RefusesAnEmptyPicture) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_png(Picture(), folder / "a.png"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

}  // namespace
}  // namespace isolux
