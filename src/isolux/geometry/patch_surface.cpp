#include "isolux/geometry/patch_surface.h"

#include <fmt/format.h>

#include <bit>

#include "isolux/core/error.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {
namespace {

constexpr std::size_t kMostPieces = 1 << 16;  ///< of all patches, where these are fewer
constexpr int kMostHalvings = 7;              ///< of a patch
/// Where pieces are cut: not in the middle, so that what is symmetric has no seams in its plane of
/// symmetry, along which drawn lines run.
constexpr double kCut = 0.4937;

bool by_t(const Hit& a, const Hit& b) { return a.t < b.t; }

/// Five points of Gauss in each direction, on cells × cells cells.
double area_of(const RationalPatch& patch, std::size_t cells) {
  // Abramowitz and Stegun, table 25.4.
  constexpr std::array<double, 5> kAt = {-0.906179845938664, -0.538469310105683, 0,
                                         0.538469310105683, 0.906179845938664};
  constexpr std::array<double, 5> kWeight = {0.236926885056189, 0.478628670499366,
                                             0.568888888888889, 0.478628670499366,
                                             0.236926885056189};
  const double n = static_cast<double>(cells);
  const auto at = [&](std::size_t i) {
    return (static_cast<double>(i / 5) + 0.5 * (1 + kAt[i % 5])) / n;
  };
  double sum = 0;
  for (std::size_t i = 0; i < 5 * cells; ++i) {
    for (std::size_t j = 0; j < 5 * cells; ++j) {
      const auto [point, along_u, along_v] = patch.at({at(i), at(j)});
      sum += kWeight[i % 5] * kWeight[j % 5] * length(cross(along_u, along_v));
    }
  }
  return sum / (4 * n * n);
}

/// Cells are halved until that changes nothing, or there are that many along each side.
double converged_area(const RationalPatch& patch, std::size_t most_cells) {
  constexpr double kSame = 1e-8;
  double coarse = 0, fine = area_of(patch, 1);
  for (std::size_t cells = 2; cells <= most_cells && std::abs(fine - coarse) > kSame * fine;
       cells *= 2) {
    coarse = fine, fine = area_of(patch, cells);
  }
  return fine;
}

/// Whether it is a surface, and no line or point.
bool has_area(const RationalPatch& patch) {
  Bounds box;
  for (std::size_t i = 0; i < 16; ++i) box.include(patch.point(i));
  const double size = box.diagonal();
  return size > 1e-9 && area_of(patch, 1) > 1e-12 * size * size;
}

}  // namespace

/// A line in the local frame, its origin the point nearest to the centre, with unit direction.
struct PatchSurface::Line {
  Ray local;
  double shift;  ///< from the ray's origin to that of the line, m
  double speed;  ///< m for each t

  double t(const Vec3& point, double unit) const {
    return (shift + dot(point - local.origin, local.direction) * unit) / speed;
  }
};

PatchSurface::PatchSurface(const std::vector<ControlPoints>& patches, std::string_view field,
                           Degenerate degenerate) {
  if (patches.empty()) throw InputError(fmt::format("{}: must be one at least", field));
  for (const ControlPoints& points : patches) {
    for (const ControlPoint& p : points) {
      require_point(p.place, field);
      bounds_.include(p.place);
    }
  }
  center_ = bounds_.center();
  unit_ = 0.5 * bounds_.diagonal();
  require_length(unit_, field);
  patches_.reserve(patches.size());
  const int most_halvings = std::min(
      kMostHalvings, static_cast<int>(std::bit_width(1 + kMostPieces / patches.size())) - 1);
  for (const ControlPoints& points : patches) {
    RationalPatch patch;
    for (std::size_t i = 0; i < 16; ++i) {
      const auto& [place, weight] = points[i];
      const Vec3 p = (place - center_) / unit_ * weight;
      for (int axis = 0; axis < 3; ++axis) patch.part[axis].c[i] = p[axis];
      patch.part[3].c[i] = weight;
    }
    if (has_area(patch)) {
      patches_.push_back(patch);
      add_pieces(patch, most_halvings);
    } else if (degenerate == Degenerate::refused) {
      throw InputError(fmt::format("{}: number {} has no area", field, patches_.size() + 1));
    }
  }
  pieces_.shrink_to_fit();
  if (patches_.empty()) throw InputError(fmt::format("{}: the surface has no area", field));
  std::vector<Bounds> boxes;
  Bounds all;
  for (const PatchPiece& piece : pieces_) {
    const Vec3 room = Vec3{1, 1, 1} * 1e-9;
    boxes.push_back({piece.bounds().lower - room, piece.bounds().upper + room});
    all.include(part_bounds(boxes.size() - 1));
  }
  bounds_ = all;
  tree_ = BoxTree(boxes);
}

void PatchSurface::add_pieces(const RationalPatch& patch, int most_halvings) {
  const PatchPiece piece(patch);
  if (most_halvings == 0 || piece.flat()) {
    pieces_.push_back(piece);
    return;
  }
  for (const RationalPatch& part : patch.split(piece.bent_axis(), kCut)) {
    add_pieces(part, most_halvings - 1);
  }
}

Bounds PatchSurface::part_bounds(std::size_t part) const {
  const Bounds& box = pieces_[part].bounds();
  const Vec3 room = Vec3{1, 1, 1} * kHair;
  return {max(bounds_.lower, center_ + (box.lower - room) * unit_),
          min(bounds_.upper, center_ + (box.upper + room) * unit_)};
}

std::optional<PatchSurface::Line> PatchSurface::line(const Ray& ray) const {
  const double speed = length(ray.direction);
  const Vec3 d = ray.direction / speed;
  const double shift = dot(center_ - ray.origin, d);
  const Vec3 origin = (ray.origin + d * shift - center_) / unit_;
  if (!(length_squared(origin) <= 1)) return std::nullopt;  // the patches lie in the unit ball
  return Line{{origin, d}, shift, speed};
}

template <typename Visit>
bool PatchSurface::any_hit(std::size_t part, const Line& line, const Visit& visit) const {
  thread_local std::vector<Place> places;
  places.clear();
  pieces_[part].find(line.local, places);
  return std::any_of(places.begin(), places.end(), [&](const Place& place) {
    const Vec3 point = pieces_[part].point(place);
    return visit(line.t(point, unit_), point, place);
  });
}

void PatchSurface::add_hits(std::size_t part, const Line& line, Hits& hits) const {
  any_hit(part, line, [&](double t, const Vec3& point, const Place& place) {
    const Vec3 normal = pieces_[part].normal(place).value_or(-line.local.direction);
    hits.push_back({t, center_ + point * unit_, normal, 0});
    return false;
  });
}

bool PatchSurface::blocks(std::size_t part, const Line& line, double t_min, double t_max) const {
  return any_hit(part, line,
                 [&](double t, const Vec3&, const Place&) { return t > t_min && t < t_max; });
}

void PatchSurface::intersect_part(std::size_t part, const Ray& ray, Hits& hits) const {
  const auto first = static_cast<std::ptrdiff_t>(hits.size());
  if (const auto l = line(ray)) add_hits(part, *l, hits);
  std::sort(hits.begin() + first, hits.end(), by_t);
}

void PatchSurface::intersect(const Ray& ray, Hits& hits) const {
  const auto first = static_cast<std::ptrdiff_t>(hits.size());
  const auto l = line(ray);
  if (!l) return;
  tree_.any([&](const Bounds& box) { return meets(l->local, box); },
            [&](std::uint32_t part) {
              add_hits(part, *l, hits);
              return false;
            });
  std::sort(hits.begin() + first, hits.end(), by_t);
}

bool PatchSurface::part_occludes(std::size_t part, const Ray& ray, double t_min,
                                 double t_max) const {
  const auto l = line(ray);
  return l && blocks(part, *l, t_min, t_max);
}

bool PatchSurface::occludes(const Ray& ray, double t_min, double t_max) const {
  const auto l = line(ray);
  return l && tree_.any([&](const Bounds& box) { return meets(l->local, box); },
                        [&](std::uint32_t part) { return blocks(part, *l, t_min, t_max); });
}

std::optional<double> PatchSurface::area() const {
  const std::size_t most_cells = patches_.size() > 4096 ? 2 : 8;
  double sum = 0;
  for (const RationalPatch& patch : patches_) sum += converged_area(patch, most_cells);
  return sum * unit_ * unit_;
}

/// The same cells for all patches, so that those that share an edge share its points; scaled about
/// the middle of all.
std::optional<TriangleSoup> PatchSurface::triangulate(double max_edge) const {
  const double count = static_cast<double>(patches_.size());
  const double least_cells =
      std::clamp(std::floor(std::sqrt(kMostTriangles / (4 * count))), 1.0, 8.0);
  double longest = 0;  // of the control polygons, no shorter than their curves
  for (const RationalPatch& patch : patches_) {
    const auto side = [&](std::size_t i, std::size_t j) {
      return distance(patch.point(i), patch.point(j)) * unit_;
    };
    for (std::size_t line = 0; line < 4; ++line) {
      double row = 0, column = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        row += side(4 * line + i, 4 * line + i + 1);
        column += side(4 * i + line, 4 * i + 4 + line);
      }
      longest = std::max({longest, row, column});
    }
  }
  const double cells = std::max(least_cells, piece_count(longest, max_edge));
  require_few_triangles(2 * cells * cells * count);
  TriangleSoup all;
  for (const RationalPatch& patch : patches_) {
    append(all, grid(cells, cells, false, [&](double u, double v) {
             return center_ + patch.at({u, v}).point * unit_;
           }));
  }
  scale_to_area(all, center_, *area());
  return all;
}

}  // namespace isolux
