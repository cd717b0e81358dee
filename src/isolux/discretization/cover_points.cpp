#include "isolux/discretization/cover_points.h"

#include <numbers>

namespace isolux {
namespace {

constexpr double kTau = 2 * std::numbers::pi;
// Sizes grow by this much a metre.
constexpr double kGrading = 0.5;
// The least distance of two points, and of a point from a crease, in sizes.
constexpr double kApart = 0.85;
constexpr double kFromCrease = 0.5;

}  // namespace

CoverPoints::CoverPoints(const SurfaceWalk& walk, const LightReach& light, double spacing,
                         std::uint64_t seed, std::function<bool()> keep_going)
    : walk_(walk),
      light_(light),
      spacing_(spacing),
      random_(seed),
      grid_(walk.rays().scene().bounds().lower, walk.rays().scene().objects.size()),
      crease_grid_(walk.rays().scene().bounds().lower),
      dark_grid_(walk.rays().scene().bounds().lower, walk.rays().scene().objects.size()),
      keep_going_(std::move(keep_going)) {
  for (const Object& object : walk.rays().scene().objects) {
    const double across = object.shape->bounds().diagonal();
    largest_.push_back(std::min(spacing, across * std::clamp(0.5 - across / spacing, 0.25, 0.5)));
  }
}

/// Whether to go on after another step; the caller is asked now and then, and once refused, it is
/// refused for good.
bool CoverPoints::going() {
  constexpr std::size_t kFirstLook = 4096, kBetweenLooks = 128;  // steps
  ++steps_;
  if (!stopped_ && keep_going_ && steps_ >= kFirstLook && steps_ % kBetweenLooks == 0) {
    stopped_ = !keep_going_();
  }
  return !stopped_;
}

double CoverPoints::fineness(double size) const {
  return std::max(1e-5 * size, 0.5 * walk_.rays().epsilon());
}

/// The spacing at a point that is no more than `most` and than spacings nearby on the same surface
/// let grow; beside stretched ones, stretched as they are.
PointSpacing CoverPoints::graded(const ZonePoint& point, const PointSpacing& most) const {
  thread_local std::vector<std::uint32_t> ids;
  grid_.query(point.surface.object, point.position, most.size / kGrading, 3, ids);
  PointSpacing spacing = most;
  double longest = most.longest();
  for (const std::uint32_t id : ids) {
    const CoverPoint& q = points_[id];
    if (dot(q.normal, point.normal) < 0.5) continue;
    const double grown = kGrading * distance(q.position, point.position);
    longest = std::min(longest, q.longest() + grown);
    if (q.size + grown >= spacing.size) continue;
    spacing.size = q.size + grown;
    if (most.stretch == 1) spacing.ruling = q.ruling;
  }
  spacing.stretch = std::max(1.0, longest / spacing.size);
  if (spacing.stretch > 1) spacing.ruling = tangential(spacing.ruling, point.normal);
  if (!(length_squared(spacing.ruling) > 0.5)) spacing.ruling = {}, spacing.stretch = 1;
  return spacing;
}

bool CoverPoints::crowded(const ZonePoint& point, const PointSpacing& spacing) const {
  thread_local std::vector<std::uint32_t> ids;
  grid_.query(point.surface.object, point.position, kApart * spacing.longest(), 1, ids);
  return crowded_by(ids, point, spacing);
}

/// Whether points that can be seen from here, each within twice its size, stand on all sides.
bool CoverPoints::surrounded(const ZonePoint& point) const {
  constexpr double kNear = 2;         // sizes
  constexpr std::size_t kMost = 16;   // points, the nearest
  constexpr double kWidestGap = 3.0;  // rad
  thread_local std::vector<std::uint32_t> ids;
  grid_.query(point.surface.object, point.position, kNear * largest_on(point), kNear, ids);
  std::vector<std::pair<double, std::uint32_t>> near;
  for (const std::uint32_t id : ids) {
    const CoverPoint& q = points_[id];
    const Vec3 d = q.position - point.position;
    if (dot(q.normal, point.normal) < walk_.cos_normal_tolerance()) continue;
    if (q.measure(d) < kNear * q.size) near.emplace_back(q.measure(d) / q.size, id);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), kMost));
  const Frame frame(point.normal);
  std::vector<double> angles;
  for (const auto& [away, id] : near) {
    const CoverPoint& q = points_[id];
    if (!walk_.open(q, point)) continue;
    const Vec3 d = q.position - point.position;
    const double angle = std::atan2(dot(d, frame.v), dot(d, frame.u));
    angles.insert(std::upper_bound(angles.begin(), angles.end(), angle), angle);
    double widest = angles.front() + kTau - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i) {
      widest = std::max(widest, angles[i] - angles[i - 1]);
    }
    if (widest < kWidestGap) return true;
  }
  return false;
}

/// Whether a point that can be seen from here stands too close for another one.
bool CoverPoints::crowded_in_sight(const ZonePoint& point) const {
  const PointSpacing most{largest_on(point)};
  thread_local std::vector<std::uint32_t> ids;
  grid_.query(point.surface.object, point.position, kApart * most.size, 1, ids);
  return std::any_of(ids.begin(), ids.end(), [&](std::uint32_t id) {
    return crowded_by({&id, 1}, point, most) && walk_.open(points_[id], point);
  });
}

/// Whether the height of one point over the other is no more than that of a curved surface; else
/// one may be of another sheet close by.
bool CoverPoints::level(const SurfacePoint& q, const SurfacePoint& point) {
  const Vec3 d = q.position - point.position;
  const double height = std::abs(dot(d, point.normal));
  return height <= (length(q.normal - point.normal) + 1e-3) * length(d);
}

bool CoverPoints::crowded_by(std::span<const std::uint32_t> ids, const ZonePoint& point,
                             const PointSpacing& spacing) const {
  return std::any_of(ids.begin(), ids.end(), [&](std::uint32_t id) {
    const CoverPoint& q = points_[id];
    const Vec3 d = q.position - point.position;
    const double apart = (q.on_crease() ? 0.75 : 1) * kApart;
    if (spacing.measure(d) >= apart * spacing.size || q.measure(d) >= apart * q.size) return false;
    if (dot(q.normal, point.normal) < walk_.cos_normal_tolerance()) return false;
    if (level(q, point)) return true;
    const auto there = walk_.over(point, q.position);
    return there && distance(there->position, q.position) < 1e-3 * spacing.size;
  });
}

void CoverPoints::add(const CoverPoint& point, const Surroundings& around) {
  const auto id = static_cast<std::uint32_t>(points_.size());
  points_.push_back(point);
  surroundings_.push_back(around);
  surroundings_.back().creases.clear();
  along_crease_.emplace_back();
  grid_.insert(id, point.surface.object, point.position, point.longest());
  if (point.on_crease()) crease_grid_.insert(id, point.position, point.longest());
  front_.push({point.size, id});
}

void CoverPoints::grow_from(const ZonePoint& point) {
  if (!going() || surrounded(point)) return;
  begin_at(point);
  for (std::size_t next = 0; next < beyond_.size() && going(); ++next) {
    const ZonePoint from = beyond_[next];
    if (!crowded_in_sight(from)) begin_at(from);
  }
  beyond_.clear();
}

/// Covers the patch around a point, if light reaches that.
void CoverPoints::begin_at(const ZonePoint& point) {
  constexpr double kNear = 0.25;  // sizes: light may get to other places of a patch
  const auto beside = light_.beside(point, random_);
  if ((!beside || lit(*beside, kNear)) && lit(point)) look_from(point, {largest_on(point)});
  spawn_all();
}

/// Whether it is known of a point of the same surface that light does not reach it, no further than
/// `sizes` times the largest size.
bool CoverPoints::in_the_dark(const ZonePoint& point, double sizes) const {
  thread_local std::vector<std::uint32_t> ids;
  dark_grid_.query(point.surface.object, point.position, sizes * largest_on(point), 1, ids);
  return std::ranges::any_of(
      ids, [&](std::uint32_t id) { return walk_.step(dark_[id], point.position).has_value(); });
}

/// Whether light reaches the point; places that it does not reach are remembered, for as many sizes
/// around.
bool CoverPoints::lit(const ZonePoint& point, double sizes) {
  if (light_.sees_light(point, random_)) return true;
  if (in_the_dark(point, sizes)) return false;
  if (light_.is_on_path_of_light(point, random_)) return true;
  dark_grid_.insert(static_cast<std::uint32_t>(dark_.size()), point.surface.object, point.position,
                    largest_on(point));
  dark_.push_back(point);
  return false;
}

void CoverPoints::spawn_all() {
  while (!front_.empty() && going()) {
    const std::uint32_t parent = front_.top().second;
    front_.pop();
    spawn(parent);
  }
}

void CoverPoints::settle() {
  if (stopped_) return;
  const std::vector<CoverPoint> points = std::move(points_);
  const std::vector<Surroundings> around = std::move(surroundings_);
  const auto along = std::move(along_crease_);
  points_.clear(), surroundings_.clear(), along_crease_.clear();
  grid_.clear(), crease_grid_.clear();

  std::vector<std::uint32_t> ids(points.size());
  std::vector<Front> between;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (points[i].on_crease()) {
      ids[i] = static_cast<std::uint32_t>(points_.size());
      add(points[i], around[i]);
    } else {
      between.emplace_back(around[i].size, i);
    }
  }
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    for (const std::uint32_t k : along[i]) along_crease_[ids[i]].push_back(ids[k]);
  }
  std::sort(between.begin(), between.end());
  for (const auto& [size, i] : between) {
    if (const auto contact = contact_beside(points[i])) accept(*contact, around[i]);
  }
  for (const auto& [size, i] : between) {
    while (!front_.empty() && front_.top().first < size && going()) {
      const std::uint32_t parent = front_.top().second;
      front_.pop();
      spawn(parent);
    }
    accept(points[i], around[i]);
  }
  spawn_all();
  while (!beyond_.empty() && going()) {
    const ZonePoint point = beyond_.back();
    beyond_.pop_back();
    if (!crowded_in_sight(point)) begin_at(point);
  }
}

Vec3 CoverPoints::any_direction(const ZonePoint& point) {
  const Frame frame(point.normal);
  const double angle = kTau * random_.uniform();
  return frame.u * std::cos(angle) + frame.v * std::sin(angle);
}

/// Makes points of the creases around a point that light reaches, and of itself where they leave
/// room.
void CoverPoints::look_from(const ZonePoint& point, const PointSpacing& most) {
  const Surroundings around = look_around(point, any_direction(point), most);
  for (const Ending& ending : around.creases) {
    const double size = around.along(ending.direction);
    if (ending.distance > 1.2 * size) continue;
    crease_seeds_.push_back({point, ending.direction, ending.distance, size, ending.last});
  }
  run_creases();
  accept(point, around);
}

void CoverPoints::accept(const ZonePoint& point, const Surroundings& around) {
  CoverPoint accepted;
  static_cast<ZonePoint&>(accepted) = point;
  static_cast<PointSpacing&>(accepted) = graded(point, around);
  if (around.to_crease < kFromCrease * accepted.size || crowded(point, accepted)) return;
  add(accepted, around);
}

void CoverPoints::spawn(std::uint32_t id) {
  constexpr int kTries = 14;
  constexpr double kFarthest = 1.3;  // children, in sizes
  if (!surroundings_[id].lit) return;
  const CoverPoint parent = points_[id];
  const Frame frame(parent.normal);
  const double first = kTau * random_.uniform();
  // All that may crowd a child; those that are born meanwhile come behind.
  std::vector<std::uint32_t> ids;
  grid_.query(parent.surface.object, parent.position, (kFarthest + kApart) * parent.longest(),
              kFarthest + kApart, ids);
  std::size_t known = points_.size();
  for (int k = 0; k < kTries; ++k) {
    const double angle = first + kTau * k / kTries;
    const double r = parent.size * (1 + (kFarthest - 1) * random_.uniform());
    const Vec3 d = parent.stretched((frame.u * std::cos(angle) + frame.v * std::sin(angle)) * r);
    if (dot(d, parent.inward) < 0) continue;
    ZonePoint guess = parent;
    guess.position += d;
    for (; known < points_.size(); ++known) ids.push_back(static_cast<std::uint32_t>(known));
    if (crowded_by(ids, guess, parent)) continue;
    const auto child = walk_.step(parent, guess.position);
    if (!child) continue;
    adjoin(parent, *child);
    PointSpacing most = parent;
    most.size = std::min(spacing_, 1.5 * parent.size);
    if (crowded(*child, most)) continue;
    if (lit(*child)) {
      look_from(*child, most);
    } else {
      Surroundings around = look_around(*child, any_direction(*child), most);
      around.lit = false;
      accept(*child, around);
    }
  }
}

void CoverPoints::run_creases() {
  while (!crease_seeds_.empty()) {
    const CreaseSeed seed = crease_seeds_.back();
    crease_seeds_.pop_back();
    trace(seed);
  }
}

}  // namespace isolux
