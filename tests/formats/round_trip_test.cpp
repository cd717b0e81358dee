#include "formats/round_trip.h"

#include <gmock/gmock.h>

#include "formats/one_object.h"
#include "formats/temporary_folder.h"
#include "geometry/zoo.h"
#include "isolux/formats/mgf/mgf.h"
#include "isolux/formats/mgf/write_mgf.h"
#include "isolux/formats/radiance/read_radiance.h"
#include "isolux/formats/radiance/write_radiance.h"
#include "isolux/formats/save_scene.h"
#include "isolux/formats/scene_file.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/torus.h"
#include "support/scenes.h"

namespace isolux {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

struct Format {
  const char* name;
  WrittenScene (*write)(const Scene& scene);
  SceneFile (*parse)(const std::string& text, const fs::path& file);
};

void PrintTo(const Format& format, std::ostream* out) { *out << format.name; }

const Format kMgf{"Mgf", write_mgf, parse_mgf};
const Format kRadiance{"Radiance", write_radiance, parse_radiance};

class RoundTrip : public testing::TestWithParam<Format> {
 protected:
  static SceneFile read_back(const WrittenScene& written) {
    return GetParam().parse(written.text, "written");
  }
};

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip, testing::Values(kMgf, kRadiance),
                         [](const auto& format) { return std::string(format.param.name); });

std::vector<ShapePtr> shapes_of(const Format& format) {
  std::vector<ShapePtr> shapes = simple_shapes();
  if (std::string(format.name) == "Mgf") {
    const auto torus = std::make_shared<Torus>(Vec3{1, 2, 3}, Vec3{0, 0.6, 0.8}, 1, 0.3);
    shapes.insert(shapes.end(), {torus, std::make_shared<Reversed>(torus)});
  }
  return shapes;
}

Scene scene_of(const std::vector<ShapePtr>& shapes) {
  Scene scene = varied_scene(shapes);
  std::erase_if(scene.objects, [](const Object& object) {
    return object.emits() && !object.shape->triangulate(1);
  });
  return scene;
}

TEST_P(RoundTrip, WhatTheFormatHasComesBackAsItWas) {
  const Scene before = scene_of(shapes_of(GetParam()));
  const WrittenScene written = GetParam().write(before);
  EXPECT_THAT(written.notes, testing::Each(testing::Not(HasSubstr("triangles"))));
  const SceneFile file = read_back(written);
  EXPECT_THAT(file.notes, IsEmpty());
  expect_same_objects(before, file.scene);
}

// A map that keeps angles, turned, made larger and mirrored.
TEST_P(RoundTrip, SoDoMovedSurfaces) {
  const Affine map = Affine::translate({1, -2, 0.5}) * Affine::rotate({1, 2, 3}, 0.8) *
                     Affine::scale({1.5, 1.5, -1.5});
  std::vector<ShapePtr> shapes = shapes_of(GetParam());
  for (ShapePtr& shape : shapes) shape = std::make_shared<Instance>(shape, map);
  Scene before = scene_of(shapes);
  const SceneFile file = read_back(GetParam().write(before));
  EXPECT_THAT(file.notes, IsEmpty());
  Random random(1);
  ASSERT_EQ(file.scene.objects.size(), before.objects.size());
  for (std::size_t i = 0; i < before.objects.size(); ++i) {
    const Object &x = before.objects[i], &y = file.scene.objects[i];
    SCOPED_TRACE(x.name);
    EXPECT_EQ(x.sides, y.sides);
    EXPECT_NEAR(surface_area(*x.shape).value(), surface_area(*y.shape).value(), 1e-9);
    EXPECT_NEAR(luminous_flux(x), luminous_flux(y), 1e-6 * luminous_flux(x));
    const Bounds box = y.shape->bounds();
    for (int k = 0; k < 200; ++k) {
      const Ray line = random_line(random, box.center(), 0.5 * box.diagonal(), 5);
      const Hits there = hits_of(*x.shape, line), here = hits_of(*y.shape, line);
      ASSERT_EQ(there.size(), here.size());
      for (std::size_t n = 0; n < here.size(); ++n) {
        EXPECT_LT(distance(there[n].point, here[n].point), 1e-9);
        EXPECT_LT(distance(there[n].normal, here[n].normal), 1e-6);
      }
    }
  }
}

// Along random lines the surfaces that are read back are met where the shape is, and on the same
// side: to 1e-6 m where nothing was noted, else to twice the deviation that was. What is too thin
// for triangles was noted too.
TEST_P(RoundTrip, EveryShapeIsMetWhereItWas) {
  for (const Specimen& specimen : zoo()) {
    SCOPED_TRACE(specimen.name);
    const WrittenScene written = GetParam().write(one_object(specimen.shape));
    double deviation = 0;
    for (const std::string& note : written.notes) {
      const std::size_t at = note.find("up to ");
      if (at != note.npos) deviation = std::stod(note.substr(at + 6));
    }
    const bool torn = std::any_of(
        written.notes.begin(), written.notes.end(),
        [](const std::string& note) { return note.find("may be missing") != note.npos; });
    const Scene after = read_back(written).scene;
    if (torn) continue;
    const Bounds box = specimen.shape->bounds();
    EXPECT_LT(deviation, 0.05 * box.diagonal());
    const double near = deviation > 0 ? 2 * deviation : 1e-6;
    Random random(2);
    int lines = 0, alike = 0;
    for (int i = 0; i < 10'000 && lines < (deviation > 0 ? 40 : 200); ++i) {
      const Ray line = random_line(random, box.center(), 0.5 * box.diagonal(), 10);
      const Hits there = hits_of(*specimen.shape, line), here = hits_of_all(after, line);
      if (there.empty() && here.empty()) continue;
      ++lines;
      bool same = there.size() == here.size();
      for (std::size_t n = 0; same && n < here.size(); ++n) {
        same = std::abs(there[n].t - here[n].t) * std::abs(dot(there[n].normal, line.direction)) <
                   near &&
               dot(there[n].normal, here[n].normal) > (deviation > 0 ? 0.5 : 1 - 1e-6);
      }
      alike += same;
    }
    ASSERT_GE(lines, 40);
    // Triangles differ at edges, and where lines graze.
    EXPECT_GE(alike, (deviation > 0 ? 0.9 : 0.995) * lines) << deviation << " of " << lines;
  }
}

TEST_P(RoundTrip, LightsWithoutASurfaceAreNoted) {
  Scene scene = one_object(simple_shapes().front());
  scene.sources = {{}, {}};
  EXPECT_THAT(GetParam().write(scene).notes,
              testing::ElementsAre("lights without a surface are left out (2)"));
}

// Whatever the scenes kept beside the project hold can be written, and gives as much light.
TEST(RoundTripOfScenes, FluxAndAreaStay) {
  ISOLUX_NEED_SCENES();
  const TemporaryFolder folder;
  int scenes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(shared_dir() / "scenes")) {
    const fs::path& path = entry.path();
    const bool of_radiance = path.string().find("radiance-obj") != std::string::npos;
    const auto extension = path.extension();
    const bool known = extension == ".mgf" || extension == ".ray" || extension == ".obj" ||
                       extension == ".pbrt" || extension == ".rif";
    if (!entry.is_regular_file() || !(known || of_radiance)) continue;
    SceneFile before;
    try {
      before = load_scene_file(path, of_radiance ? "radiance" : "");
    } catch (const InputError&) {
      continue;  // a part of a scene, or none at all
    }
    SCOPED_TRACE(path.string());
    ++scenes;
    const double flux = total_flux_of(before.scene);
    const std::optional<double> area = total_area_of(before.scene);
    for (const std::string name : {"a.yaml", "a.mgf", "a.rad"}) {
      SCOPED_TRACE(name);
      try {
        const auto notes = save_scene(before.scene, folder.path() / name);
        const Scene after = load_scene_file(folder.path() / name).scene;
        EXPECT_NEAR(total_flux_of(after), flux, 1e-6 * flux);
        const bool exact = std::none_of(notes.begin(), notes.end(), [](const std::string& note) {
          return note.find(" m off") != note.npos;
        });
        if (exact && area) {
          EXPECT_NEAR(total_area_of(after).value(), *area, 1e-6 * *area);
        }
      } catch (const InputError& error) {
        ADD_FAILURE() << error.what();
      }
    }
  }
  EXPECT_GE(scenes, 60);
}

}  // namespace
}  // namespace isolux
