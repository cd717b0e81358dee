#include "isolux/radiosity/hemisphere_gather.h"

#include <algorithm>

#include "isolux/radiosity/hemisphere_rays.h"

namespace isolux {
namespace {

// Brighter, in parts of the mean irradiance, than what rays over a hemisphere find well enough.
constexpr double kBright = 2;
// Of the irradiance, a ray over a grid of kUsualGrid cells a side may carry no more than this.
constexpr double kMostOfAll = 1.0 / 400;
constexpr double kUsualGrid = 16;

constexpr double square(double x) { return x * x; }

/// The numbers of a row's rays from `first` on, those of a tile of cells one after the other:
/// neighbours in this order run close together.
void tile_by_tile(const Row<Landing>& row, std::size_t first, std::size_t count,
                  std::vector<std::uint32_t>& order) {
  constexpr int kTile = 4;  // cells a side
  order.clear();
  for (int top = 0; first == 0 && top < row.grid; top += kTile) {
    for (int left = 0; left < row.grid; left += kTile) {
      for (int j = top; j < std::min(top + kTile, row.grid); ++j) {
        for (int i = left; i < std::min(left + kTile, row.grid); ++i) {
          order.push_back(static_cast<std::uint32_t>(j * row.grid + i));
        }
      }
    }
  }
  while (first + order.size() < count) {
    order.push_back(static_cast<std::uint32_t>(first + order.size()));
  }
}

template <typename Ray, typename Radiosity>
Rgb mean(const Row<Ray>& row, const Radiosity& radiosity) {
  return mean_over(row, [&](std::size_t i) { return radiosity(row.rays[i]); });
}

/// What ray i of a kept row brings, while what a later one brings is fetched from memory.
Rgb arriving(const Row<Link>& row, std::span<const SiteLight> sites, std::size_t i) {
  constexpr std::size_t kAhead = 16;
  if (i + kAhead < row.rays.size()) __builtin_prefetch(&sites[row.rays[i + kAhead].site]);
  return sites[row.rays[i].site].at(row.rays[i].weights);
}

/// As HemisphereGather::gather_with_error() has it; `radiosity` by the ray's number.
template <typename Ray, typename Radiosity>
Gathered mean_with_error(const Row<Ray>& row, const Radiosity& radiosity) {
  thread_local std::vector<Rgb> arriving;
  thread_local std::vector<double> values;
  arriving.clear(), values.clear();
  for (std::size_t i = 0; i < row.rays.size(); ++i) {
    arriving.push_back(radiosity(i));
    values.push_back(luminance(arriving.back()));
  }
  return {mean_over(row, [&](std::size_t i) { return arriving[i]; }),
          std::sqrt(variance_of_mean(row.grid, row.divided, values))};
}

}  // namespace

HemisphereGather::HemisphereGather(const RayCaster& rays, const Triangulation& mesh,
                                   std::span<const std::uint8_t> separate,
                                   std::span<const Rgb> irradiance)
    : rays_(rays), mesh_(mesh), lookup_(mesh, &rays) {
  const Scene& scene = rays.scene();
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Rgb reflectance = scene.material_of(i).reflectance;
    const Rgb emission = separate[i] ? Rgb{} : scene.objects[i].exitance;
    surfaces_.push_back({reflectance, emission});
    surfaces_.push_back({reflectance, {}});
    surfaces_.push_back({{}, emission});
  }
  surfaces_.resize(surface_count(scene));
  if (scene.sky) sky_.emplace(*scene.sky);
  if (!irradiance.empty()) find_bright_places(mesh, separate, irradiance);
}

void HemisphereGather::find_bright_places(const Triangulation& mesh,
                                          std::span<const std::uint8_t> separate,
                                          std::span<const Rgb> irradiance) {
  std::vector<double> radiosity(mesh.triangles().size());
  double incident = 0, area = 0;
  for (TriangleId id = 0; id < radiosity.size(); ++id) {
    const Triangle& triangle = mesh.triangle(id);
    if (!triangle.alive) continue;
    const auto& corners = triangle.vertices;
    const Rgb emission =
        separate[mesh.vertex(corners[0]).surface.object] ? Rgb{} : triangle.emission;
    for (const VertexId v : corners) {
      incident += luminance(irradiance[v]) * triangle.area / 3;
      const double b = luminance(emission + mesh.vertex(v).reflectance * irradiance[v]);
      radiosity[id] = std::max(radiosity[id], b);
    }
    area += triangle.area;
  }
  if (!(incident > 0)) return;
  mean_irradiance_ = incident / area;
  bright_ = BrightPlaces(mesh, radiosity, kBright * mean_irradiance_);
  for (const Rgb& e : irradiance) irradiance_.push_back(static_cast<float>(luminance(e)));
}

/// The irradiance there, as the mesh has it, lx; not less than what counts as dim.
double HemisphereGather::expected_at(const Receiver& receiver) const {
  constexpr double kDim = 0.25;  // of the mean
  double expected = 0;
  if (const auto place = lookup_.place(receiver.point, receiver.normal)) {
    for (std::size_t k = 0; k < 3; ++k) {
      expected += place->weights[k] * double(irradiance_[place->vertices[k]]);
    }
  }
  return std::max(expected, kDim * mean_irradiance_);
}

/// Divides the cells in which bright places may lie.
void HemisphereGather::divide(const Receiver& receiver, const HemisphereRays& rays,
                              Row<Landing>& row) const {
  constexpr double kMostParts = 16;
  constexpr double kFewestParts = 3;
  constexpr double kMostRays = 2;  // for each cell of the row
  if (bright_.empty()) return;
  thread_local std::vector<BrightPlaces::Cone> cones;
  const double half_a_cell = 1.0 / row.grid;
  // A cell of radiosity b is divided into b / unit, if that is more than a few.
  const double unit = kMostOfAll * square(kUsualGrid) * expected_at(receiver);
  bright_.seen_from(receiver.point, receiver.normal, square(kFewestParts) * unit,
                    half_a_cell / kMostStretch, cones);
  if (cones.empty()) return;
  thread_local std::vector<double> brightest;  // by cell, lm/m²
  brightest.assign(row.cells(), 0);
  for (const BrightPlaces::Cone& cone : cones) {
    const Point2 p = rays.square_of(cone.direction);
    const double reach = kMostStretch * cone.chord;
    const auto cell = [&](double x) {
      return std::clamp(static_cast<int>((x + 1) / 2 * row.grid), 0, row.grid - 1);
    };
    for (int j = cell(p.y - reach); j <= cell(p.y + reach); ++j) {
      for (int i = cell(p.x - reach); i <= cell(p.x + reach); ++i) {
        double& b = brightest[static_cast<std::size_t>(j * row.grid + i)];
        b = std::max(b, cone.radiosity);
      }
    }
  }
  const auto parts = [&](double b) { return std::min(std::sqrt(b / unit), kMostParts); };
  double sum = 0;
  for (const double b : brightest) sum += parts(b) * parts(b);
  const double scale = std::min(1.0, std::sqrt(kMostRays * double(row.cells()) / sum));
  for (std::size_t c = 0; c < brightest.size(); ++c) {
    const double n = scale * parts(brightest[c]);
    if (n < kFewestParts) continue;
    row.divided.push_back({static_cast<std::uint16_t>(c), static_cast<std::uint16_t>(n)});
  }
}

/// Divides the cells at the rims of what is seen of the sky, as their neighbours tell: what a
/// cell's own ray met has no say, so that on average the row brings what is there.
void HemisphereGather::divide_rims(Row<Landing>& row) const {
  // Of n² rays in a cell with a rim the variance is some n⁻³ of a single one's, the square of what
  // the sky brings more than the rest: to spread rays well, n goes with that to the power of 2/5.
  constexpr double kParts = 1.5, kMostParts = 16;
  constexpr double kMostRays = 2;  // for each cell of the row
  const std::uint32_t outside = outside_of(rays_.scene());
  const auto seen = [&](int i, int j) {
    return row.rays[static_cast<std::size_t>(j * row.grid + i)].site.surface == outside;
  };
  thread_local std::vector<std::uint16_t> rims;
  rims.clear();
  std::size_t open = 0;
  for (int j = 0; j < row.grid; ++j) {
    for (int i = 0; i < row.grid; ++i) {
      open += seen(i, j);
      int beside = 0, of_sky = 0;
      for (int y = std::max(j - 1, 0); y <= std::min(j + 1, row.grid - 1); ++y) {
        for (int x = std::max(i - 1, 0); x <= std::min(i + 1, row.grid - 1); ++x) {
          if (x == i && y == j) continue;
          ++beside;
          of_sky += seen(x, y);
        }
      }
      if (of_sky > 0 && of_sky < beside) rims.push_back(std::uint16_t(j * row.grid + i));
    }
  }
  if (rims.empty() || open == 0) return;
  const double most = std::sqrt(kMostRays * double(row.cells()) / double(rims.size()));
  const double parts = kParts * std::pow(double(row.cells()) / double(open), 0.4);
  const auto n = static_cast<std::uint16_t>(std::max(2.0, std::min({parts, most, kMostParts})));
  thread_local std::vector<std::uint8_t> divided;
  divided.assign(row.cells(), 0);
  for (const DividedCell& cell : row.divided) divided[cell.cell] = 1;
  for (const std::uint16_t cell : rims) {
    if (!divided[cell]) row.divided.push_back({cell, n});
  }
}

/// Whether the vertices that have the light of what a ray met are much further from it than its
/// origin is: in a hole of its mesh, or in a triangle between faces that are turned to each other.
bool HemisphereGather::much_closer(const Origin& origin, const SurfaceHit& hit,
                                   const MeshPlace& place, bool covered) const {
  constexpr double kMuchFurther = 4;
  constexpr double kFacing = -0.7;  // cosine
  const Vertex& nearest = mesh_.vertex(place.vertices[0]);
  if (!covered) {
    return nearest.surface.object == hit.surface.object &&
           distance(nearest.position, hit.point) > kMuchFurther * hit.t;
  }
  if (kMuchFurther * hit.t > mesh_.rules().max_edge) return false;
  if (dot(origin.receiver.normal, hit.normal) > kFacing) return false;
  return std::all_of(place.vertices.begin(), place.vertices.end(), [&](VertexId v) {
    return distance(mesh_.vertex(v).position, hit.point) > kMuchFurther * hit.t;
  });
}

/// Where the mesh has the light of what a ray met, under a triangle if `covering`. Where no
/// triangle lies, vertices near by have it; but where surfaces come closer than the mesh can
/// follow, as where bodies touch, one is as dark as the other, and as the darkest place around.
std::optional<MeshPlace> HemisphereGather::place_of(
    Origin& origin, const SurfaceHit& hit, const std::optional<MeshPlace>& covering) const {
  const bool covered = covering.has_value();
  const std::optional<MeshPlace> place =
      covered ? covering : lookup_.nearest(hit.point, hit.normal);
  if (!place || !much_closer(origin, hit, *place, covered)) return place;
  if (!origin.looked) {
    origin.looked = true;
    origin.own = lookup_.place(origin.receiver.point, origin.receiver.normal);
    if (origin.own) origin.own = darkest_of(*origin.own);
  }
  return origin.own ? origin.own : place;
}

/// The darkest of the vertices that a place lies among; the place itself where it is a vertex.
MeshPlace HemisphereGather::darkest_of(const MeshPlace& place) const {
  constexpr double kThere = 0.99;  // of the weights
  const auto& [vertices, weights] = place;
  if (irradiance_.empty() || *std::max_element(weights.begin(), weights.end()) > kThere) {
    return place;
  }
  const VertexId darkest =
      *std::min_element(vertices.begin(), vertices.end(),
                        [&](VertexId v, VertexId w) { return irradiance_[v] < irradiance_[w]; });
  return {{darkest, darkest, darkest}, {1, 0, 0}};
}

Landing HemisphereGather::landing_at(std::uint32_t surface, const MeshPlace& place) {
  Landing landing{{surface, place.vertices}};
  for (std::size_t k = 0; k < 2; ++k) {
    landing.weights[k] = static_cast<std::uint16_t>(place.weights[k + 1] / kSiteWeightUnit);
  }
  return landing;
}

Landing HemisphereGather::landing_of(Origin& origin, const Ray& ray,
                                     const std::optional<SurfaceHit>& hit,
                                     const std::optional<MeshPlace>& covering) const {
  const std::uint32_t outside = outside_of(rays_.scene());
  const Landing black{{outside - 1, {}}};
  if (!hit) return sky_ ? landing_at(outside, sky_->place(ray.direction)) : Landing{{outside, {}}};
  if (dot(hit->normal, ray.direction) >= 0) return black;
  const std::uint32_t surface = 3 * hit->surface.object;
  const std::optional<MeshPlace> place = place_of(origin, *hit, covering);
  if (!place) return hit->back ? black : Landing{{surface + 2, {}}};
  return landing_at(surface + hit->back, *place);
}

/// Where rays of the row from number `first` on land.
void HemisphereGather::land(Origin& origin, std::span<const Ray> rays, std::size_t first,
                            Row<Landing>& row) const {
  thread_local std::vector<std::uint32_t> order;
  tile_by_tile(row, first, rays.size(), order);
  thread_local std::vector<Ray> in_order;
  in_order.clear();
  for (const std::uint32_t i : order) in_order.push_back(rays[i]);
  thread_local std::vector<std::optional<SurfaceHit>> hits;
  hits.resize(order.size());
  rays_.nearest(in_order, hits);
  thread_local std::vector<std::optional<MeshPlace>> covering;
  covering.resize(order.size());
  lookup_.covering(hits, covering);
  row.rays.resize(rays.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    row.rays[order[k]] = landing_of(origin, in_order[k], hits[k], covering[k]);
  }
}

void HemisphereGather::trace(const Receiver& receiver, int grid, std::uint64_t seed,
                             std::uint64_t id, Row<Landing>& row, Rims rims) const {
  Random random(seed, id);
  HemisphereRays rays(receiver, rays_.epsilon(), grid, random);
  row.grid = grid;
  row.divided.clear();
  divide(receiver, rays, row);
  rays.send_to_cells();
  for (const DividedCell& cell : row.divided) rays.send_to_parts(cell);
  Origin origin{receiver};
  land(origin, rays.rays(), 0, row);
  // The one ray of a divided cell does not count: there it must not look like noise of others.
  for (const DividedCell& cell : row.divided) {
    if (cell.cell > 0) row.rays[cell.cell] = row.rays[cell.cell - 1u];
  }
  if (!sky_ || rims == Rims::as_they_are) return;
  const std::size_t landed = row.rays.size(), known = row.divided.size();
  divide_rims(row);
  if (row.divided.size() == known) return;
  for (std::size_t k = known; k < row.divided.size(); ++k) rays.send_to_parts(row.divided[k]);
  land(origin, rays.rays(), landed, row);
}

SiteLight HemisphereGather::light_of(const Site& site, std::span<const Rgb> irradiance) const {
  const auto narrow = [](const Rgb& c) {
    return std::array{static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
  };
  const auto& [a, b, c] = site.vertices;
  if (shows_sky(site)) {
    const std::span<const Rgb> sky = sky_->radiosity();
    return {narrow(sky[a]), narrow(sky[b] - sky[a]), narrow(sky[c] - sky[a])};
  }
  const Surface& surface = surfaces_[site.surface];
  return {narrow(surface.emission + surface.reflectance * irradiance[a]),
          narrow(surface.reflectance * (irradiance[b] - irradiance[a])),
          narrow(surface.reflectance * (irradiance[c] - irradiance[a]))};
}

Rgb HemisphereGather::reflected(const Row<Landing>& row, std::span<const Rgb> irradiance) const {
  return mean(row, [&](const Landing& landing) {
    if (shows_sky(landing.site)) return Rgb{};
    return light_of(landing.site, irradiance).at(landing.weights) -
           surfaces_[landing.site.surface].emission;
  });
}

Rgb HemisphereGather::gather(const Row<Landing>& row, std::span<const Rgb> irradiance) const {
  return mean(row, [&](const Landing& landing) {
    return light_of(landing.site, irradiance).at(landing.weights);
  });
}

Gathered HemisphereGather::gather_with_error(const Row<Landing>& row,
                                             std::span<const Rgb> irradiance) const {
  return mean_with_error(row, [&](std::size_t i) {
    return light_of(row.rays[i].site, irradiance).at(row.rays[i].weights);
  });
}

Rgb gather(const Row<Link>& row, std::span<const SiteLight> sites) {
  return mean_over(row, [&](std::size_t i) { return arriving(row, sites, i); });
}

Gathered gather_with_error(const Row<Link>& row, std::span<const SiteLight> sites) {
  return mean_with_error(row, [&](std::size_t i) { return arriving(row, sites, i); });
}

}  // namespace isolux
