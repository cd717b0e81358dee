#include <fmt/format.h>

#include "isolux/formats/rayshade/height_field.h"
#include "isolux/formats/rayshade/make.h"
#include "isolux/formats/rayshade/parser.h"
#include "isolux/geometry/blob.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/frustum.h"
#include "isolux/geometry/polygon.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/torus.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux::rayshade {
namespace {

constexpr const char* kFlatFacets =
    "normals at the corners of triangles left out: facets are flat, as drawn";

}  // namespace

const std::map<std::string_view, Parser::Primitive>& Parser::primitives() {
  static const std::map<std::string_view, Primitive> all = {
      {"sphere", &Parser::sphere},
      {"box", &Parser::box},
      {"plane", &Parser::plane},
      {"cylinder", &Parser::cylinder},
      {"cone", &Parser::cone},
      {"disc", &Parser::disc},
      {"torus", &Parser::torus},
      {"triangle", &Parser::triangle},
      {"triangleuv", &Parser::triangle_with_uv},
      {"poly", &Parser::poly},
      {"blob", &Parser::blob},
      {"heightfield", &Parser::height_field},
  };
  return all;
}

void Parser::sphere(Node& node) {
  const double radius = tokens_.number();
  node.geometry = ShapePtr(make<Sphere>(node.place, node.word, tokens_.vector(), radius));
}

void Parser::box(Node& node) {
  const Vec3 a = tokens_.vector(), b = tokens_.vector();
  node.geometry = ShapePtr(make<Box>(node.place, node.word, min(a, b), max(a, b)));
}

void Parser::plane(Node& node) {
  const Vec3 through = point(), normal = point();
  make<Disk>(node.place, node.word, through, normal, 1.0);  // looks at the numbers
  node.geometry = Plane{through, normalized(normal)};
}

void Parser::cylinder(Node& node) {
  const double radius = tokens_.number();
  const Vec3 from = tokens_.vector();
  tube(node, radius, from, radius, tokens_.vector());
}

void Parser::cone(Node& node) {
  const double from_radius = tokens_.number();
  const Vec3 from = tokens_.vector();
  const double to_radius = tokens_.number();
  tube(node, from_radius, from, to_radius, tokens_.vector());
}

void Parser::tube(Node& node, double from_radius, const Vec3& from, double to_radius,
                  const Vec3& to) {
  ShapePtr side = make<Frustum>(node.place, node.word, from, to, from_radius, to_radius, false);
  node.geometry = Tube{from, to, from_radius, to_radius, std::move(side)};
}

void Parser::disc(Node& node) {
  const double radius = tokens_.number();
  const Vec3 center = tokens_.vector(), normal = tokens_.vector();
  ShapePtr shape = make<Disk>(node.place, node.word, center, normal, radius);
  node.geometry = Disc{center, normalized(normal), radius, std::move(shape)};
}

void Parser::torus(Node& node) {
  const double major = tokens_.number(), minor = tokens_.number();
  const Vec3 center = tokens_.vector(), axis = tokens_.vector();
  node.geometry = ShapePtr(make<Torus>(node.place, node.word, center, axis, major, minor));
}

void Parser::triangle(Node& node) {
  const Vec3 first = tokens_.vector(), second = tokens_.vector(), third = tokens_.vector();
  if (!tokens_.number_follows()) return facet(node, first, second, third);
  // Each corner was followed by the normal there.
  tokens_.skip_numbers(3);
  const Vec3 last = tokens_.vector();
  tokens_.skip_numbers(3);
  notes_.add(kFlatFacets);
  facet(node, first, third, last);
}

void Parser::triangle_with_uv(Node& node) {
  Vec3 corners[3];
  for (Vec3& corner : corners) {
    corner = tokens_.vector();
    tokens_.skip_numbers(5);
  }
  notes_.add(kFlatFacets);
  facet(node, corners[0], corners[1], corners[2]);
}

void Parser::facet(Node& node, const Vec3& a, const Vec3& b, const Vec3& c) {
  Facets facets;
  const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
  if (length(cross(b - a, c - a)) > 1e-12 * longest * longest) {
    facets.soup = {{a, b, c}, {{0, 1, 2}}};
    make<TriangleMesh>(node.place, node.word, facets.soup.points, facets.soup.triangles);
  } else {
    notes_.add("triangles without an area left out, as Rayshade does");
  }
  node.geometry = std::move(facets);
}

void Parser::poly(Node& node) {
  std::vector<Vec3> corners;
  while (tokens_.number_follows()) corners.push_back(tokens_.vector());
  const auto polygon = make<Polygon>(node.place, node.word, corners);
  constexpr double kAnySize = std::numeric_limits<double>::infinity();
  TriangleSoup soup = *polygon->triangulate(kAnySize);
  soup.points = corners;  // which flattening has moved, though facets must meet there
  node.geometry = Facets{std::move(soup), polygon};
}

void Parser::blob(Node& node) {
  const double threshold = tokens_.number();
  std::vector<BlobBall> balls;
  while (tokens_.number_follows()) {
    BlobBall ball;
    ball.strength = tokens_.number();
    ball.radius = tokens_.number();
    ball.center = tokens_.vector();
    balls.push_back(ball);
  }
  node.geometry = ShapePtr(make<Blob>(node.place, node.word, threshold, std::move(balls)));
}

void Parser::height_field(Node& node) {
  node.surface = surface_before_name();
  const Place place = tokens_.peek().place;
  const std::string name = tokens_.filename();
  try {
    node.geometry = rayshade::height_field(includes_.open(name).text);
    includes_.close();
  } catch (const InputError& error) {
    fail(place, fmt::format("'heightfield' can't be made: {}", error.what()));
  }
}

}  // namespace isolux::rayshade
