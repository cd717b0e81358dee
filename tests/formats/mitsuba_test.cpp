#include <numbers>

#include "formats/refusal.h"

namespace isolux {
namespace {
using std::numbers::pi;
using testing::Contains;
using testing::HasSubstr;

SceneFile scene_of(const std::string& elements, const std::string& version = "3.0.0") {
  return scene_in("a.xml", "<scene version='" + version + "'>\n" + elements + "</scene>\n");
}

const Object& object(const Scene& scene, const std::string& name) {
  for (const Object& o : scene.objects) {
    if (o.name == name) return o;
  }
  throw std::runtime_error("no object " + name);
}

/// What a shape faces where a ray meets it first.
Vec3 normal_seen(const Shape& shape, const Vec3& from, const Vec3& way) {
  Hits hits;
  shape.intersect({from, way}, hits);
  return hits.at(0).normal;
}

TEST(Mitsuba, CornellBox) {
  const SceneFile file =
      load_scene_file(std::string(ISOLUX_SOURCE_DIR) + "/tests/formats/mitsuba/cornell.xml");
  const Scene& scene = file.scene;
  ASSERT_EQ(scene.objects.size(), 9u);
  const std::tuple<const char*, double, Vec3> walls[] = {
      {"floor", 4, {0, 1, 0}}, {"ceiling", 4, {0, -1, 0}}, {"back", 4, {0, 0, 1}},
      {"left", 4, {1, 0, 0}},  {"right", 4, {-1, 0, 0}},   {"lamp", 0.2, {0, -1, 0}}};
  for (const auto& [name, area, normal] : walls) {
    const Shape& wall = *object(scene, name).shape;
    EXPECT_NEAR(surface_area(wall).value(), area, 1e-12) << name;
    EXPECT_LT(distance(normal_seen(wall, wall.bounds().center() + normal, Vec3{} - normal), normal),
              1e-12)
        << name;
  }
  EXPECT_NEAR(surface_area(*object(scene, "box").shape).value(), 6 * 0.36, 1e-12);
  EXPECT_TRUE(object(scene, "box").shape->solid());
  EXPECT_NEAR(surface_area(*object(scene, "column").shape).value(), 2 * pi * 0.25 * 1.2, 1e-12);
  EXPECT_NEAR(surface_area(*object(scene, "ball").shape).value(), 4 * pi * 0.04, 1e-12);
  EXPECT_LT(distance(object(scene, "ball").shape->bounds().center(), {0.4, 0.8, 0.35}), 1e-12);
  // π × area × 179 lm/W × brightness.
  EXPECT_NEAR(luminous_flux(object(scene, "lamp")),
              pi * 0.2 * 179 * (0.265 * 18 + 0.670 * 15 + 0.065 * 8), 1e-6);
  EXPECT_EQ(object(scene, "floor").sides, Sides::both);
  EXPECT_EQ(object(scene, "left").sides, Sides::front);

  const auto reflectance = [&](const char* name) {
    return scene.materials[object(scene, name).material].reflectance;
  };
  EXPECT_EQ(reflectance("box"), gray(0.75));
  EXPECT_EQ(reflectance("left"), (Rgb{0.6, 0.05, 0.04}));
  EXPECT_EQ(reflectance("ball"), gray(0));
  EXPECT_EQ(scene.materials[object(scene, "left").material].name, "red");
  EXPECT_THAT(file.notes, Contains("'conductor': black, as it mirrors alone"));

  const Camera& camera = scene.cameras.at(0);
  EXPECT_EQ(camera.name, "front");
  EXPECT_LT(distance(camera.eye, {0, 1, 4.5}), 1e-12);
  EXPECT_LT(distance(camera.look_at, {0, 1, 3.5}), 1e-12);
  EXPECT_LT(distance(camera.up, {0, 1, 0}), 1e-12);
  EXPECT_NEAR(camera.fov, 36, 1e-12);
  EXPECT_EQ(camera.width, 512);
  // The red wall stands left in the picture.
  Hits hits;
  object(scene, "left").shape->intersect(camera.ray(0.1, 0.5), hits);
  EXPECT_EQ(hits.size(), 1u);
}

TEST(Mitsuba, ShapesHaveTheirArea) {
  const std::pair<std::string, double> cases[] = {
      {"<shape type='rectangle'/>", 4},
      {"<shape type='disk'/>", pi},
      {"<shape type='cube'/>", 24},
      {"<shape type='sphere'><float name='radius' value='2'/></shape>", 16 * pi},
      {"<shape type='cylinder'/>", 2 * pi},
      {"<shape type='disk'><transform name='to_world'><scale value='3'/></transform></shape>",
       9 * pi},
      {"<shape type='rectangle'><transform name='to_world'><matrix value='2 1 0 5 0 3 0 6 0 0 1 7 "
       "0 0 0 1'/></transform></shape>",
       24},
      {"<shape type='merge'><shape type='rectangle'/></shape>", 4},
  };
  for (const auto& [text, area] : cases) {
    const Scene scene = scene_of(text).scene;
    EXPECT_NEAR(surface_area(*scene.objects.at(0).shape).value(), area, 1e-9) << text;
  }
}

TEST(Mitsuba, StepsOfATransformComeInOrder) {
  const Scene scene =
      scene_of(
          "<shape type='sphere'><transform name='to_world'><translate x='1'/>"
          "<scale x='2' y='2' z='2'/><rotate z='1' angle='90'/></transform></shape>")
          .scene;
  EXPECT_LT(distance(scene.objects[0].shape->bounds().center(), {0, 2, 0}), 1e-12);
  EXPECT_LT(distance(scene.objects[0].shape->bounds().upper, {2, 4, 2}), 1e-12);
}

TEST(Mitsuba, NormalsFlipAndSurviveMirrors) {
  const auto normal = [](const std::string& type, const std::string& more) {
    const Scene scene = scene_of("<shape type='" + type + "'>" + more + "</shape>").scene;
    return normal_seen(*scene.objects[0].shape, {0.2, 0.1, -9}, {0, 0, 1}).z;
  };
  const std::string flip = "<boolean name='flip_normals' value='true'/>";
  const std::string mirror = "<transform name='to_world'><scale x='-1'/></transform>";
  for (const char* const open : {"rectangle", "disk"}) {
    EXPECT_NEAR(normal(open, ""), 1, 1e-12);
    EXPECT_NEAR(normal(open, flip), -1, 1e-12);
    EXPECT_NEAR(normal(open, mirror), 1, 1e-12);
    EXPECT_NEAR(normal(open, flip + mirror), -1, 1e-12);
  }
  EXPECT_NEAR(normal("cube", ""), -1, 1e-12);
  EXPECT_NEAR(normal("cube", mirror), -1, 1e-12);
  EXPECT_NEAR(normal("cube", flip), 1, 1e-12);
}

TEST(Mitsuba, MeshesOfFiles) {
  const TemporaryFolder folder;
  folder.write("parts/a.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
               "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("parts/a.obj",
               "v 0 0 0\nv 2 0 0\nv 2 1 0\nusemtl x\nf 1 2 3\nv 0 1 0\nf 1/1/1 3//2 -1\n");
  folder.write("parts/part.xml",
               "<scene version='3.0.0'><shape type='ply' id='tri'>"
               "<string name='filename' value='parts/a.ply'/></shape></scene>");
  const auto file = folder.write(
      "a.xml",
      "<scene version='3.0.0'><include filename='parts/part.xml'/><shape type='obj' id='quad'>"
      "<string name='filename' value='parts/a.obj'/>"
      "<transform name='to_world'><scale x='-1'/></transform></shape></scene>");
  const Scene scene = load_scene_file(file).scene;
  EXPECT_NEAR(surface_area(*object(scene, "tri").shape).value(), 0.5, 1e-12);
  EXPECT_NEAR(surface_area(*object(scene, "quad").shape).value(), 2, 1e-12);
  EXPECT_NEAR(normal_seen(*object(scene, "quad").shape, {-0.5, 0.5, -1}, {0, 0, 1}).z, 1, 1e-12);
}

TEST(Mitsuba, GroupsArePlacedByInstances) {
  const Scene scene =
      scene_of(
          "<shape type='shapegroup' id='pair'><shape type='sphere' id='ball'/>"
          "<shape type='cube'><transform name='to_world'><translate z='3'/></transform></shape>"
          "</shape>"
          "<shape type='instance' id='one'><ref id='pair'/></shape>"
          "<shape type='instance' id='two'><ref id='pair'/>"
          "<transform name='to_world'><scale value='2'/><translate x='9'/></transform></shape>")
          .scene;
  ASSERT_EQ(scene.objects.size(), 4u);
  EXPECT_EQ(scene.objects[0].name, "one/ball");
  EXPECT_NEAR(surface_area(*object(scene, "two/ball").shape).value(), 16 * pi, 1e-9);
  EXPECT_LT(distance(object(scene, "two/cube").shape->bounds().center(), {9, 0, 6}), 1e-12);
}

TEST(Mitsuba, MaterialsByTheirDiffusePart) {
  const auto look = [](const std::string& bsdf) {
    const SceneFile file = scene_of("<shape type='rectangle'>" + bsdf + "</shape>");
    return file.scene.materials.at(0).reflectance;
  };
  const std::string red = "<bsdf type='diffuse'><rgb name='reflectance' value='.6,.2,.1'/></bsdf>";
  const std::string board =
      "<texture type='checkerboard' name='reflectance'><rgb name='color0' value='.2,.4,.6'/>"
      "<rgb name='color1' value='0'/></texture>";
  const Rgb r{0.6, 0.2, 0.1};
  EXPECT_EQ(look(""), gray(0.5));
  EXPECT_EQ(look(red), r);
  EXPECT_EQ(look("<bsdf type='twosided'>" + red + "</bsdf>"), r);
  EXPECT_EQ(look("<bsdf type='mask'>" + red + "</bsdf>"), r);
  EXPECT_EQ(
      look("<bsdf type='bumpmap'><texture type='bitmap' name='arbitrary'/>" + red + "</bsdf>"), r);
  EXPECT_EQ(look("<bsdf type='diffuse'>" + board + "</bsdf>"), (Rgb{0.1, 0.2, 0.3}));
  EXPECT_EQ(look("<bsdf type='roughplastic'/>"), gray(0.5));
  EXPECT_EQ(look("<bsdf type='hair'/>"), gray(0.5));
  EXPECT_EQ(look("<bsdf type='plastic'><spectrum name='diffuse_reflectance' value='0.3'/></bsdf>"),
            gray(0.3));
  EXPECT_EQ(look("<bsdf type='principled'><rgb name='base_color' value='.8'/>"
                 "<float name='metallic' value='.5'/></bsdf>"),
            gray(0.4));
  EXPECT_EQ(look("<bsdf type='blendbsdf'><float name='weight' value='.25'/>" + red +
                 "<bsdf type='conductor'/></bsdf>"),
            r * 0.75);
  const Rgb half = look("<bsdf type='diffuse'><srgb name='reflectance' value='#bcbcbc'/></bsdf>");
  EXPECT_NEAR(half.g, 0.503, 0.001);
}

TEST(Mitsuba, SpectraAreSeenByTheEye) {
  const auto look = [](const std::string& value) {
    return scene_of("<shape type='disk'><bsdf type='diffuse'><spectrum name='reflectance' " +
                    value + "</bsdf></shape>")
        .scene.materials.at(0)
        .reflectance;
  };
  EXPECT_NEAR(luminance(look("value='300:0.4, 900:0.4'/>")), 0.4, 1e-4);
  const Rgb red = look("value='300:0 580:0 620:0.8 800:0.8'/>");
  EXPECT_GT(red.r, 5 * red.g);
  EXPECT_EQ(look("type='uniform'><float name='value' value='0.3'/></spectrum>"), gray(0.3));
}

TEST(Mitsuba, SurfacesOfGlassAreLeftOut) {
  const SceneFile file = scene_of(
      "<shape type='sphere'><bsdf type='dielectric'/></shape>"
      "<shape type='rectangle'><bsdf type='thindielectric'/></shape><shape type='disk'/>");
  EXPECT_EQ(file.scene.objects.size(), 1u);
  EXPECT_THAT(file.notes, Contains("'dielectric' and 'thindielectric': surfaces left out, light "
                                   "passes unhindered"));
}

TEST(Mitsuba, LightsAreMeasuredByTheEye) {
  const SceneFile file = scene_of(
      "<emitter type='point'><rgb name='intensity' value='1,2,3'/>"
      "<point name='position' x='1' y='2' z='3'/></emitter>"
      "<emitter type='spot'><transform name='to_world'><lookat origin='0,0,5' target='0,0,0' "
      "up='0,1,0'/></transform><float name='cutoff_angle' value='40'/></emitter>"
      "<emitter type='directional'><vector name='direction' x='0' y='0' z='-2'/>"
      "<spectrum name='irradiance' value='2'/></emitter>"
      "<emitter type='constant'/><emitter type='envmap'/>"
      "<shape type='disk'><emitter type='area'><spectrum name='radiance' value='2'/></emitter>"
      "</shape>");
  ASSERT_EQ(file.scene.sources.size(), 3u);
  const Source &point = file.scene.sources[0], &spot = file.scene.sources[1],
               &sun = file.scene.sources[2];
  EXPECT_NEAR(luminance(point.intensity), 179 * (0.265 * 1 + 0.670 * 2 + 0.065 * 3), 1e-9);
  EXPECT_EQ(point.position, (Vec3{1, 2, 3}));
  EXPECT_LT(distance(spot.position, {0, 0, 5}), 1e-12);
  EXPECT_LT(distance(spot.direction, {0, 0, -1}), 1e-12);
  EXPECT_NEAR(spot.dark_angle, 40, 1e-12);
  EXPECT_NEAR(spot.full_angle, 30, 1e-12);
  EXPECT_EQ(sun.kind, Source::Kind::directional);
  EXPECT_EQ(sun.direction, (Vec3{0, 0, -1}));
  EXPECT_NEAR(sun.intensity.g, 2 * 179, 1e-9);
  EXPECT_NEAR(luminous_flux(file.scene.objects.at(0)), 2 * 179 * pi * pi, 1e-9);
  EXPECT_THAT(file.notes, Contains(HasSubstr("'constant' and 'envmap' left out")));
}

TEST(Mitsuba, CamerasSeeTheSameAngle) {
  const auto fov = [](const std::string& parameters) {
    return scene_of("<shape type='disk'/><sensor type='thinlens'>" + parameters +
                    "<film type='hdrfilm'><integer name='width' value='400'/>"
                    "<integer name='height' value='200'/></film></sensor>")
        .scene.cameras.at(0)
        .fov;
  };
  const auto degrees = [](double half_height) { return 2 * std::atan(half_height) * 180 / pi; };
  const std::string right = "<float name='fov' value='90'/>";
  const auto along = [](const std::string& axis) {
    return "<string name='fov_axis' value='" + axis + "'/>";
  };
  EXPECT_NEAR(fov(right), degrees(0.5), 1e-9);
  EXPECT_NEAR(fov(right + along("y")), 90, 1e-9);
  EXPECT_NEAR(fov(right + along("smaller")), 90, 1e-9);
  EXPECT_NEAR(fov(right + along("larger")), degrees(0.5), 1e-9);
  EXPECT_NEAR(fov(right + along("diagonal")), degrees(1 / std::sqrt(5)), 1e-9);
  EXPECT_NEAR(fov("<string name='focal_length' value='50mm'/>"),
              degrees(std::hypot(36, 24) / 100 / std::sqrt(5)), 1e-9);
  EXPECT_NEAR(fov(""), degrees(std::hypot(36, 24) / 100 / std::sqrt(5)), 1e-9);
}

TEST(Mitsuba, ParametersAndOlderNames) {
  const Scene scene =
      scene_of(
          "<default name='r' value='2'/><default name='r' value='5'/>"
          "<default name='radius' value='$r'/>"
          "<shape type='sphere'><float name='radius' value='$radius.5'/>"
          "<transform name='toWorld'><lookAt origin='0,0,$r' target='0,0,0' up='0,1,0'/>"
          "</transform></shape>",
          "0.6.0")
          .scene;
  const Bounds box = scene.objects[0].shape->bounds();
  EXPECT_LT(distance(box.center(), {0, 0, 2}), 1e-12);
  EXPECT_NEAR(box.upper.x, 2.5, 1e-12);
}

}  // namespace
}  // namespace isolux
