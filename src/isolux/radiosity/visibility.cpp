#include "isolux/radiosity/visibility.h"

#include <vector>

namespace isolux {
namespace {

/// A point of the emitter in barycentric coordinates.
using Barycentric = std::array<double, 3>;

Barycentric between(const Barycentric& a, const Barycentric& b, double s) {
  return {a[0] + (b[0] - a[0]) * s, a[1] + (b[1] - a[1]) * s, a[2] + (b[2] - a[2]) * s};
}

/// A piece of the emitter, with what is seen of its corners.
struct Piece {
  std::array<Barycentric, 3> corners;
  std::array<std::uint8_t, 3> visible;

  int visible_count() const { return visible[0] + visible[1] + visible[2]; }
};

/// One receiver's view of the emitter.
class View {
 public:
  /// `blockers`: what may stand between the two.
  View(const RayCaster& rays, const Emitter& emitter, const Receiver& receiver,
       const Blockers& blockers)
      : rays_(rays), emitter_(emitter), receiver_(receiver), blockers_(blockers) {}

  /// Form factor to what is seen of `piece`, which is cut in four `probes` times even where its
  /// corners agree.
  double form_factor_of(const Piece& piece, int probes, int subdivisions) {
    const int seen = piece.visible_count();
    if (probes == 0) {
      if (seen == 0) return 0;
      if (seen == 3) return polygon(piece.corners);
      if (subdivisions == 0) return cut_at_shadow_edge(piece);
    }
    const int less_probes = std::max(0, probes - 1);
    const int less = probes > 0 ? subdivisions : subdivisions - 1;

    const auto& [a, b, c] = piece.corners;
    const std::array<Barycentric, 3> middle{between(a, b, 0.5), between(b, c, 0.5),
                                            between(c, a, 0.5)};
    std::array<std::uint8_t, 3> open;
    look(middle, open);
    const auto& [ab, bc, ca] = middle;
    const auto& v = piece.visible;
    double sum = form_factor_of({{a, ab, ca}, {v[0], open[0], open[2]}}, less_probes, less);
    sum += form_factor_of({{ab, b, bc}, {open[0], v[1], open[1]}}, less_probes, less);
    sum += form_factor_of({{ca, bc, c}, {open[2], open[1], v[2]}}, less_probes, less);
    sum += form_factor_of({{ab, bc, ca}, {open[0], open[1], open[2]}}, less_probes, less);
    return sum;
  }

  /// Where visibility is asked for: on the true surface, a hair above it.
  Vec3 lifted(const Barycentric& b) const {
    const double lift = b[0] * b[1] * emitter_.bulge[0] + b[1] * b[2] * emitter_.bulge[1] +
                        b[2] * b[0] * emitter_.bulge[2] + rays_.epsilon();
    return flat(b) + emitter_.normal * lift;
  }
  Vec3 start() const { return receiver_.point + receiver_.normal * rays_.epsilon(); }

  std::uint64_t ray_count = 0;

 private:
  Vec3 flat(const Barycentric& b) const {
    const auto& [p, q, r] = emitter_.corners;
    return p * b[0] + q * b[1] + r * b[2];
  }

  template <std::size_t N>
  double polygon(const std::array<Barycentric, N>& corners) const {
    std::array<Vec3, N> points;
    for (std::size_t i = 0; i < N; ++i) points[i] = flat(corners[i]);
    return form_factor(receiver_.point, receiver_.normal, points);
  }

  template <std::size_t N>
  void look(const std::array<Barycentric, N>& points, std::array<std::uint8_t, N>& visible) {
    std::array<Segment, N> segments;
    for (std::size_t i = 0; i < N; ++i) segments[i] = {start(), lifted(points[i])};
    rays_.occluded(blockers_, segments, visible);
    for (auto& v : visible) v = !v;
    ray_count += N;
  }

  /// One corner of the piece differs from the two others: finds where the shadow's edge crosses
  /// the two sides that meet there, and measures the polygon on the lit side of it.
  double cut_at_shadow_edge(const Piece& piece) {
    const int odd = piece.visible[0] == piece.visible[1]   ? 2
                    : piece.visible[1] == piece.visible[2] ? 0
                                                           : 1;
    const Barycentric& tip = piece.corners[odd];
    const std::array<Barycentric, 2> other{piece.corners[(odd + 1) % 3],
                                           piece.corners[(odd + 2) % 3]};
    // Each round narrows both crossings to one eighth.
    constexpr int kParts = 8;
    std::array<double, 2> from{0, 0};
    double step = 1.0 / kParts;
    for (int round = 0; round < 2; ++round, step /= kParts) {
      std::array<Barycentric, 2 * (kParts - 1)> points;
      std::array<std::uint8_t, 2 * (kParts - 1)> visible;
      for (int side = 0; side < 2; ++side) {
        for (int k = 1; k < kParts; ++k) {
          points[side * (kParts - 1) + k - 1] = between(tip, other[side], from[side] + k * step);
        }
      }
      look(points, visible);
      for (int side = 0; side < 2; ++side) {
        int k = 1;
        while (k < kParts && visible[side * (kParts - 1) + k - 1] == piece.visible[odd]) ++k;
        from[side] += (k - 1) * step;
      }
    }
    const double half = step * kParts / 2;
    const Barycentric cut0 = between(tip, other[0], from[0] + half);
    const Barycentric cut1 = between(tip, other[1], from[1] + half);
    if (piece.visible[odd]) return polygon(std::array{tip, cut0, cut1});
    return polygon(std::array{cut0, other[0], other[1], cut1});
  }

  const RayCaster& rays_;
  const Emitter& emitter_;
  const Receiver& receiver_;
  const Blockers& blockers_;
};

// Receivers that are looked at together.
constexpr std::size_t kGroup = 32;

constexpr std::array<Barycentric, 3> kCorners{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Whether some of the emitter stands above the receiver's horizon, and the receiver before it.
bool may_see(const Emitter& emitter, const Receiver& receiver, double epsilon) {
  if (dot(receiver.point - emitter.corners[0], emitter.normal) <= epsilon) return false;
  for (const Vec3& corner : emitter.corners) {
    if (dot(corner - receiver.point, receiver.normal) > epsilon) return true;
  }
  return false;
}

/// visible_form_factors() of a group of neighbours that may see the emitter, by their indices.
std::uint64_t group_form_factors(const RayCaster& rays, const Emitter& emitter,
                                 const Bounds& targets, std::span<const Receiver> receivers,
                                 std::span<const std::uint32_t> group, int subdivisions,
                                 std::span<double> factors) {
  Bounds starts;
  for (std::uint32_t i : group) starts.include(receivers[i].point);
  // Where nothing stands between them and the emitter, they see it whole.
  const Blockers blockers = rays.blockers(starts, targets);
  if (blockers.none()) {
    form_factors(receivers, group, emitter.corners, factors);
    return 0;
  }

  // The others ask; all for one corner together, since such rays run close to one another.
  const std::size_t n = group.size();
  std::array<Segment, 3 * kGroup> segments;
  std::array<std::uint8_t, 3 * kGroup> blocked;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (std::size_t k = 0; k < n; ++k) {
      const View view(rays, emitter, receivers[group[k]], blockers);
      segments[corner * n + k] = {view.start(), view.lifted(kCorners[corner])};
    }
  }
  rays.occluded(blockers, std::span(segments).first(3 * n), blocked);
  std::uint64_t ray_count = 3 * n;
  std::array<std::uint32_t, kGroup> open;
  std::size_t open_count = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (!emitter.light && !(blocked[k] | blocked[n + k] | blocked[2 * n + k])) {
      open[open_count++] = group[k];
      continue;
    }
    View view(rays, emitter, receivers[group[k]], blockers);
    Piece whole{kCorners, {}};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      whole.visible[corner] = !blocked[corner * n + k];
    }
    factors[group[k]] = view.form_factor_of(whole, emitter.light ? 2 : 0, subdivisions);
    ray_count += view.ray_count;
  }
  form_factors(receivers, std::span(open).first(open_count), emitter.corners, factors);
  return ray_count;
}

}  // namespace

Emitter emitter_of(const Triangulation& mesh, TriangleId id) {
  const Triangle& triangle = mesh.triangle(id);
  Emitter emitter;
  emitter.normal = triangle.normal;
  emitter.light = triangle.on_light;
  for (int k = 0; k < 3; ++k) emitter.corners[k] = mesh.vertex(triangle.vertices[k]).position;
  for (int k = 0; k < 3; ++k) {
    const Vertex& a = mesh.vertex(triangle.vertices[k]);
    const Vertex& b = mesh.vertex(triangle.vertices[(k + 1) % 3]);
    // Along a side the surface is, to second order, a parabola over its chord.
    const double rise = 0.5 * dot(b.normal - a.normal, b.position - a.position);
    emitter.bulge[k] = 1.1 * std::max(0.0, rise);
  }
  return emitter;
}

std::uint64_t visible_form_factors(const RayCaster& rays, const Emitter& emitter,
                                   std::span<const Receiver> receivers, int subdivisions,
                                   std::span<double> factors) {
  thread_local std::vector<std::uint32_t> facing;
  facing.clear();
  for (std::uint32_t i = 0; i < receivers.size(); ++i) {
    factors[i] = 0;
    if (may_see(emitter, receivers[i], rays.epsilon())) facing.push_back(i);
  }
  Bounds targets;
  for (const Vec3& corner : emitter.corners) targets.include(corner);
  const double bulge = emitter.bulge[0] + emitter.bulge[1] + emitter.bulge[2];
  targets.lower -= Vec3{bulge, bulge, bulge};
  targets.upper += Vec3{bulge, bulge, bulge};
  std::uint64_t ray_count = 0;
  for (std::size_t first = 0; first < facing.size(); first += kGroup) {
    const auto group = std::span(facing).subspan(first, std::min(kGroup, facing.size() - first));
    ray_count +=
        group_form_factors(rays, emitter, targets, receivers, group, subdivisions, factors);
  }
  return ray_count;
}

}  // namespace isolux
