#include "isolux/scene/length.h"

#include <gmock/gmock.h>

#include "scene/scene_text.h"

namespace isolux {
namespace {

double radius_of(const std::string& radius, const std::string& top = "") {
  const Object object =
      read_object("    shape: {sphere: {center: [0, 0, 0], radius: " + radius + "}}\n", top);
  return object.shape->bounds().upper.x;
}

TEST(Length, UnitsOfText) {
  EXPECT_DOUBLE_EQ(radius_of("0.3"), 0.3);
  EXPECT_DOUBLE_EQ(radius_of("30 cm"), 0.3);
  EXPECT_DOUBLE_EQ(radius_of("30cm"), 0.3);
  EXPECT_DOUBLE_EQ(radius_of("'30 cm'"), 0.3);
  EXPECT_DOUBLE_EQ(radius_of("12 mm"), 0.012);
  EXPECT_DOUBLE_EQ(radius_of("+1.5 m"), 1.5);
  EXPECT_DOUBLE_EQ(radius_of("1e-3 km"), 1);
  EXPECT_DOUBLE_EQ(radius_of("2 in"), 0.0508);
  EXPECT_DOUBLE_EQ(radius_of(".5ft"), 0.1524);
}

TEST(Length, SceneUnitAppliesToPlainNumbersAlone) {
  EXPECT_DOUBLE_EQ(radius_of("300", "unit: mm\n"), 0.3);
  EXPECT_DOUBLE_EQ(radius_of("3 in", "unit: mm\n"), 0.0762);
}

TEST(Length, SceneUnitAppliesWhereverItStands) {
  const std::string text =
      scene_text("    shape: {sphere: {center: [0, 0, 0], radius: 5}}\n") + "unit: cm\n";
  EXPECT_DOUBLE_EQ(read_scene(text, "test.yaml").bounds().upper.x, 0.05);
}

TEST(Length, EverythingElseIsRefused) {
  for (const char* radius : {"30 cn", "cm", "30 cm 2", "0,3", "0x10", "1_000", "''", "~", "true",
                             "--1", "1e", "e5", ".", "1e10", "1e-12", "nan", "inf cm"}) {
    EXPECT_THROW(radius_of(radius), InputError) << radius;
  }
}

TEST(Length, NumbersAsYamlWritesThem) {
  EXPECT_EQ(parse_number("-1.5e2"), -150);
  EXPECT_EQ(parse_number("010"), 10);
  EXPECT_TRUE(std::isinf(parse_number("-.inf").value()));
  EXPECT_TRUE(std::isnan(parse_number(".NaN").value()));
  EXPECT_FALSE(parse_number("1 2"));
  EXPECT_FALSE(parse_number(""));
}

}  // namespace
}  // namespace isolux
