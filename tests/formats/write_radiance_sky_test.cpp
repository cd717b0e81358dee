#include <gmock/gmock.h>

#include "formats/one_object.h"
#include "formats/radiance_text.h"
#include "formats/round_trip.h"
#include "isolux/formats/mgf/write_mgf.h"
#include "isolux/formats/radiance/write_radiance.h"

namespace isolux {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Scene lit_by(const Sky& sky) {
  Scene scene = one_object(simple_shapes().front());
  scene.sky = sky;
  Source sun;
  sun.name = "sun";
  sun.kind = Source::Kind::directional;
  sun.direction = -sky.sun;
  sun.intensity = {60000, 58000, 50000};
  scene.sources = {sun};
  return scene;
}

TEST(WriteRadianceSky, EverySkyComesBack) {
  const Vec3 ups[] = {{0, 0, 1}, {0, 1, 0}, normalized({-1, -2, 0.5}), {0, 0, -1}};
  for (int type = 1; type <= kSkyTypes; ++type) {
    for (const Vec3& up : ups) {
      SCOPED_TRACE(type);
      Sky sky;
      sky.distribution = standard_sky(type);
      sky.up = up;
      sky.sun = normalized(up + Frame(up).to_world({0.7, 0.4, 0}));
      sky.zenith = {7000, 7500, 9000};
      sky.ground = {2100, 2000, 1500};
      const Scene before = lit_by(sky);
      const WrittenScene written = write_radiance(before);
      EXPECT_THAT(written.notes, IsEmpty());
      const SceneFile file = read_radiance_text(written.text);
      EXPECT_THAT(file.notes, IsEmpty());
      ASSERT_TRUE(file.scene.sky.has_value());
      const Sky& after = *file.scene.sky;
      expect_near(after.up, up, 1e-9);
      if (type != 16) expect_near(after.sun, sky.sun, 1e-9);
      expect_same_color(sky.zenith, after.zenith);
      expect_same_color(sky.ground, after.ground);
      for (const Vec3& d : {sky.sun, up, -up, normalized(up * 0.3 - sky.sun * 0.1)}) {
        expect_same_color(sky.luminance(d), after.luminance(d));
      }
      ASSERT_EQ(file.scene.sources.size(), 1u);
      const Source &a = before.sources[0], &b = file.scene.sources[0];
      EXPECT_EQ(b.name, a.name);
      EXPECT_EQ(b.kind, a.kind);
      expect_near(b.direction, a.direction, 1e-12);
      expect_same_color(a.intensity, b.intensity);
    }
  }
}

TEST(WriteRadianceSky, SoDoSkiesThatAreBlackAboveOrBelow) {
  Sky sky;
  sky.distribution = standard_sky(13);
  sky.up = {0, 0, -1};
  sky.sun = normalized({0, 1, -1});
  sky.ground = gray(100);
  for (const auto& [zenith, ground] : {std::pair{0.0, 100.0}, std::pair{100.0, 0.0}}) {
    sky.zenith = gray(zenith);
    sky.ground = gray(ground);
    const auto after = read_radiance_text(write_radiance(lit_by(sky)).text).scene.sky;
    ASSERT_TRUE(after.has_value());
    expect_near(after->up, sky.up, 1e-9);
    expect_same_color(gray(zenith), after->zenith);
    expect_same_color(gray(ground), after->ground);
  }
}

TEST(WriteRadianceSky, SkiesWithoutAFormInTheFormatAreNoted) {
  Sky sky;
  sky.zenith = gray(1000);
  sky.distribution = {1, -1, 0, -1, 0, 2};
  EXPECT_THAT(write_radiance(lit_by(sky)).notes, ElementsAre(HasSubstr("the sky is left out")));
  EXPECT_THAT(write_mgf(lit_by(sky)).notes, ElementsAre("lights without a surface are left out (1)",
                                                        "the sky is left out: MGF has none"));
}

}  // namespace
}  // namespace isolux
