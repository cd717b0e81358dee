#include "isolux/image/mesh_picture.h"

#include <memory>

#include "isolux/image/resample.h"
#include "isolux/image/surface_sampler.h"
#include "isolux/image/tone_map.h"

namespace isolux {
namespace {

constexpr double kHalfWidth = 0.55;  // of a line, pixels
constexpr double kLightening = 0.55;
constexpr double kInk = 0.02;

/// The least angle (rad) between a ray and the sides of a triangle that it meets, seen from the
/// ray's origin.
double angle_to_sides(const Triangulation& mesh, TriangleId triangle, const Ray& ray) {
  double least = 1;
  const auto& corners = mesh.triangle(triangle).vertices;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = mesh.vertex(corners[k]).position - ray.origin;
    const Vec3 b = mesh.vertex(corners[(k + 1) % 3]).position - ray.origin;
    // The side lies in a plane through the origin, at this sine from the ray.
    least = std::min(least, std::abs(dot(normalized(cross(a, b)), ray.direction)));
  }
  return std::asin(least);
}

}  // namespace

Picture mesh_picture(const Solution& solution, const Camera& camera, const RenderOptions& options) {
  const Picture shading = tone_map(render(solution, camera, options).picture);
  const SurfaceSampler sampler(solution);
  const Picture coverage = supersample(camera, options, [&]() -> Shade {
    const auto scratch = std::make_shared<SurfaceSampler::Scratch>();
    return [&, scratch](std::span<const Ray> rays, double pixel_angle) {
      int on_lines = 0;
      for (const Ray& ray : rays) {
        const std::optional<MeshHit> mesh = sampler.triangle(ray, *scratch);
        if (!mesh) continue;
        const double angle = angle_to_sides(solution.mesh, mesh->triangle, ray);
        on_lines += angle < kHalfWidth * pixel_angle;
      }
      return gray(on_lines / static_cast<double>(rays.size()));
    };
  });
  Picture picture = shading;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Rgb paper = gray(kLightening) + shading.pixels[i] * (1 - kLightening);
    const double line = coverage.pixels[i].r;
    picture.pixels[i] = paper * (1 - line) + gray(kInk) * line;
  }
  return picture;
}

}  // namespace isolux
