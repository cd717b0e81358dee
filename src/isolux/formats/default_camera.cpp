#include "isolux/formats/default_camera.h"

#include <array>
#include <numbers>

namespace isolux {
namespace {

constexpr double kInset = 0.1;       // of the scene's length and width: from walls to the eye
constexpr double kEyeHeight = 1.6;   // m
constexpr double kEyeLevel = 0.6;    // of the scene's height: at most, and where that is no room's
constexpr double kLowestRoom = 0.5;  // m
constexpr double kTallestRoom = 20;  // m
constexpr double kFieldOfView = 60;  // degrees
constexpr int kFewestWallsAround = 5;  // of six, counting floor and ceiling
constexpr double kLeastView = 0.2;     // of the way to the middle: less is no room but a thing

/// A place to stand, and what can be seen from there.
struct Stand {
  Vec3 eye;
  int walls = 0;    ///< of the directions along the axes, those that meet a surface
  double view = 1;  ///< how far it is to the first surface, of the way to the middle
};

void look_around(const Scene& scene, Stand& stand, const Vec3& middle) {
  const Ray ahead{stand.eye, middle - stand.eye};
  std::array<bool, 6> met{};
  Hits hits;
  for (const Object& object : scene.objects) {
    for (int i = 0; i < 6; ++i) {
      Vec3 direction;
      direction[i / 2] = i % 2 ? 1 : -1;
      met[i] = met[i] || object.shape->occludes({stand.eye, direction}, 0,
                                                std::numeric_limits<double>::infinity());
    }
    hits.clear();
    object.shape->intersect(ahead, hits);
    for (const Hit& hit : hits) {
      if (hit.t > 0) stand.view = std::min(stand.view, hit.t);
    }
  }
  for (const bool wall : met) stand.walls += wall;
}

/// The place in a corner of the scene's box that has walls around and the widest view; nothing
/// where none has both.
std::optional<Vec3> place_inside(const Scene& scene, const Bounds& box, int up) {
  const Vec3 size = box.upper - box.lower;
  if (size[up] < kLowestRoom) return std::nullopt;
  const double eye_level = kEyeLevel * size[up];
  Vec3 middle = box.center();
  middle[up] =
      box.lower[up] + (size[up] > kTallestRoom ? eye_level : std::min(eye_level, kEyeHeight));
  std::optional<Stand> best;
  for (int corner = 0; corner < 4; ++corner) {
    Stand stand{middle};
    const int a = (up + 1) % 3, b = (up + 2) % 3;
    stand.eye[a] += (corner % 2 ? 0.5 - kInset : kInset - 0.5) * size[a];
    stand.eye[b] += (corner / 2 ? 0.5 - kInset : kInset - 0.5) * size[b];
    if (stand.eye == middle) continue;
    look_around(scene, stand, middle);
    if (stand.walls < kFewestWallsAround || stand.view < kLeastView) continue;
    if (best && best->view >= stand.view) continue;
    best = stand;
  }
  if (!best) return std::nullopt;
  return best->eye;
}

}  // namespace

int guessed_up_axis(const Scene& scene) {
  const Bounds box = scene.bounds();
  const Vec3 size = box.upper - box.lower;
  Vec3 sum;
  double flux = 0;
  for (const Object& object : scene.objects) {
    const double weight = luminous_flux(object);
    sum += object.shape->bounds().center() * weight;
    flux += weight;
  }
  if (!(flux > 0)) return 2;
  const Vec3 place = sum / flux - box.lower;
  const double along_y = size.y > 0 ? place.y / size.y : 0.5;
  const double along_z = size.z > 0 ? place.z / size.z : 0.5;
  return along_y > 0.5 && along_y > along_z ? 1 : 2;
}

Camera default_camera(const Scene& scene) { return default_camera(scene, guessed_up_axis(scene)); }

Camera default_camera(const Scene& scene, int up) {
  const Bounds box = scene.bounds();
  Camera camera;
  camera.name = "default";
  camera.fov = kFieldOfView;
  camera.up = {};
  camera.up[up] = 1;
  camera.look_at = box.center();
  if (const auto inside = place_inside(scene, box, up)) {
    camera.eye = *inside;
    camera.look_at[up] = std::min(camera.look_at[up], camera.eye[up]);
    return camera;
  }
  // From the front, a little from the right and from above, so far off that the ball around the
  // box fits into the picture's height.
  Vec3 away;
  away[up] = 0.5;
  away[up == 2 ? 0 : 2] = up == 2 ? 0.4 : 1;
  away[up == 2 ? 1 : 0] = up == 2 ? -1 : 0.4;
  const double half_angle = 0.5 * kFieldOfView * std::numbers::pi / 180;
  camera.eye = camera.look_at + normalized(away) * (0.5 * box.diagonal() / std::sin(half_angle));
  return camera;
}

}  // namespace isolux
