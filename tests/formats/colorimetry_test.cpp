#include "isolux/formats/colorimetry.h"

#include <gtest/gtest.h>

namespace isolux {
namespace {

/// The CIE 1931 chromaticity of a colour.
void expect_chromaticity(const Vec3& xyz, double x, double y, double tolerance) {
  const double sum = xyz.x + xyz.y + xyz.z;
  EXPECT_NEAR(xyz.x / sum, x, tolerance);
  EXPECT_NEAR(xyz.y / sum, y, tolerance);
}

TEST(Colorimetry, EqualEnergyIsWhite) {
  const Vec3 flat = xyz_of_spectrum(380, 780, {1, 1});
  EXPECT_NEAR(flat.y, 1, 1e-12);
  expect_chromaticity(flat, 1.0 / 3, 1.0 / 3, 2e-5);
  const Rgb white = rec709({1, 1, 1});
  EXPECT_NEAR(white.r, 1, 1e-6);
  EXPECT_NEAR(white.g, 1, 1e-6);
  EXPECT_NEAR(white.b, 1, 1e-6);
}

TEST(Colorimetry, ChromaticityIsKept) {
  expect_chromaticity(xyz_of_chromaticity(0.45, 0.41), 0.45, 0.41, 1e-15);
  EXPECT_EQ(xyz_of_chromaticity(0.45, 0.41).y, 1);
}

// Narrow bands have the chromaticity of their wavelength on the spectral locus (CIE 15:2004).
TEST(Colorimetry, NarrowBandsLieOnTheSpectralLocus) {
  expect_chromaticity(xyz_of_spectrum(449.5, 450.5, {1, 1}), 0.1566, 0.0177, 1e-4);
  expect_chromaticity(xyz_of_spectrum(519.5, 520.5, {1, 1}), 0.0743, 0.8338, 1e-4);
  expect_chromaticity(xyz_of_spectrum(599.5, 600.5, {1, 1}), 0.6270, 0.3725, 1e-4);
}

// Points of the Planckian locus; 2856 K is CIE standard illuminant A, (0.44757, 0.40745), but for
// the constant c2 of its time, which makes a change of 1e-4.
TEST(Colorimetry, BlackBodiesLieOnThePlanckianLocus) {
  expect_chromaticity(xyz_of_black_body(2856), 0.4476, 0.4074, 2e-4);
  expect_chromaticity(xyz_of_black_body(6500), 0.3135, 0.3237, 2e-4);
  expect_chromaticity(xyz_of_black_body(1e6), 0.240, 0.234, 1e-3);
  EXPECT_TRUE(is_finite(xyz_of_black_body(100)));
  EXPECT_DOUBLE_EQ(xyz_of_black_body(4000).y, 1);
}

// The primaries of Rec. 709, carried from D65 to the equal-energy white.
TEST(Colorimetry, PrimariesAreOneChannelEach) {
  const auto primary = [](double x, double y) {
    const Rgb color = rec709(xyz_of_chromaticity(x, y));
    return color / max_channel(color);
  };
  const Rgb red = primary(0.646117, 0.328369), green = primary(0.323761, 0.585061),
            blue = primary(0.152577, 0.061689);
  EXPECT_NEAR(red.g, 0, 1e-5);
  EXPECT_NEAR(red.b, 0, 1e-5);
  EXPECT_NEAR(green.r, 0, 1e-5);
  EXPECT_NEAR(green.b, 0, 1e-5);
  EXPECT_NEAR(blue.r, 0, 1e-5);
  EXPECT_NEAR(blue.g, 0, 1e-5);
}

TEST(Colorimetry, LuminanceIsY) {
  for (double x = 0.1; x < 0.7; x += 0.1) {
    for (double y = 0.1; x + y < 1; y += 0.1) {
      EXPECT_NEAR(luminance(rec709(xyz_of_chromaticity(x, y) * 3)), 3, 1e-12);
    }
  }
}

TEST(Colorimetry, WattsBecomeLumensAsInRadiance) {
  EXPECT_NEAR(luminance_of_radiance(gray(2)).g, 2 * 179, 1e-9);
  const Rgb radiance{1, 2, 5}, seen = luminance_of_radiance(radiance);
  EXPECT_NEAR(luminance(seen), 179 * (0.265 * 1 + 0.670 * 2 + 0.065 * 5), 1e-9);
  EXPECT_NEAR(seen.g / seen.r, 2, 1e-12);
  EXPECT_NEAR(radiance_of_luminance(seen).b, 5, 1e-12);
  EXPECT_EQ(luminance_of_radiance({}), Rgb{});
}

TEST(Colorimetry, PalingKeepsLuminanceAndRange) {
  const Rgb fine{0.2, 0.5, 0.9};
  EXPECT_EQ(paled_into_range(fine, 1), fine);
  for (const Rgb& color : {Rgb{1.5, 0.2, 0.1}, Rgb{0.4, -0.1, 0.3}, Rgb{-0.1, 1.2, 0.5}}) {
    const Rgb paled = paled_into_range(color, 1);
    EXPECT_NEAR(luminance(paled), luminance(color), 1e-12);
    EXPECT_LE(max_channel(paled), 1);
    EXPECT_GE(min_channel(paled), 0);
    EXPECT_TRUE(max_channel(paled) == 1 || min_channel(paled) == 0);
  }
  EXPECT_EQ(paled_into_range(gray(3), 1), gray(1));
  EXPECT_EQ(paled_into_range({-1, 0, 0}, 1), gray(0));
}

}  // namespace
}  // namespace isolux
