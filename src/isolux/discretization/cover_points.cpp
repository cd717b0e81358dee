#include "isolux/discretization/cover_points.h"

#include <numbers>

namespace isolux {
namespace {

constexpr double kTau = 2 * std::numbers::pi;
// Neighbours are this part of the radius of curvature times α_n apart, so that Delaunay edges,
// which are up to 1.7 times as long, keep within α_n.
constexpr double kTurnPerSize = 0.55;
// Size in a strip, in widths of it; not less than this part of the spacing.
constexpr double kStripWidths = 2;
constexpr double kLeastStrip = 1.0 / 32;
// No curvature makes points finer than this part of the largest size on their object, and no edge
// between flat parts than that one.
constexpr double kLeastSize = 1.0 / 64;
constexpr double kLeastAtFolds = 1.0 / 8;
// Sizes grow by this much a metre.
constexpr double kGrading = 0.5;
// The least distance of two points, and of a point from a crease, in sizes.
constexpr double kApart = 0.85;
constexpr double kFromCrease = 0.5;
constexpr int kDirections = 8;

}  // namespace

CoverPoints::CoverPoints(const SurfaceWalk& walk, double spacing, std::uint64_t seed,
                         std::function<bool()> keep_going)
    : walk_(walk),
      spacing_(spacing),
      random_(seed),
      grid_(walk.rays().scene().bounds().lower),
      keep_going_(std::move(keep_going)) {}

/// Whether to go on; asked now and then, and once refused, refused for good.
bool CoverPoints::going() {
  constexpr std::size_t kPointsBetweenLooks = 4096;
  if (!stopped_ && keep_going_ && points_.size() >= next_look_) {
    next_look_ = points_.size() + kPointsBetweenLooks;
    if (points_.size() > 0) stopped_ = !keep_going_();
  }
  return !stopped_;
}

double CoverPoints::fineness(double size) const {
  return std::max(1e-5 * size, 0.5 * walk_.rays().epsilon());
}

/// Whether most of the turn on the way from a point to `there`, `away` from it in direction d, is
/// made at one edge between flat parts, which finer points would not make any flatter.
bool CoverPoints::turns_at_once(const ZonePoint& point, const ZonePoint& there, double away,
                                const Vec3& d) const {
  constexpr int kHalvings = 4;
  constexpr double kMost = 0.6;
  double near = 0, far = away;
  Vec3 before = point.normal, behind = there.normal;
  for (int i = 0; i < kHalvings; ++i) {
    const double t = (near + far) / 2;
    const auto found = walk_.step(point, point.position + d * t);
    if (!found) return false;
    if (angle_between(found->normal, before) < angle_between(found->normal, behind)) {
      near = t, before = found->normal;
    } else {
      far = t, behind = found->normal;
    }
  }
  return angle_between(before, behind) > kMost * angle_between(there.normal, point.normal);
}

CoverPoints::Surroundings CoverPoints::look_around(const ZonePoint& point, const Vec3& first,
                                                   double limit) const {
  constexpr double kNear = 0.35;
  const Vec3 second = cross(point.normal, first);
  Surroundings around{limit};
  const double most_turn = kTurnPerSize * walk_.normal_tolerance();
  double curvature = 0, fold = 0;
  // Over an edge so blunt that it counts as smooth, less turn than that would read as curvature.
  const auto see_turn = [&](const ZonePoint& there, double away, const Vec3& d) {
    const double turn = angle_between(there.normal, point.normal);
    if (turn <= most_turn) return;
    double& bend = turns_at_once(point, there, away, d) ? fold : curvature;
    bend = std::max(bend, turn / away);
  };
  std::array<double, kDirections> ends;
  ends.fill(std::numeric_limits<double>::infinity());
  for (int k = 0; k < kDirections; ++k) {
    const double angle = kTau * k / kDirections;
    const Vec3 d = first * std::cos(angle) + second * std::sin(angle);
    double near = 0, far = 0;
    for (const double t : {kNear * limit, limit}) {
      const auto found = walk_.step(point, point.position + d * t);
      if (!found) {
        far = t;
        break;
      }
      near = t;
      see_turn(*found, t, d);
    }
    if (far == 0) continue;
    const Rim rim = walk_.rim(point, d, near, far, limit / 64);
    if (rim.distance > 0) see_turn(rim.point, rim.distance, d);
    const Vec3 on = tangential(d, rim.point.normal);
    if (!walk_.step(rim.point, rim.point.position + on * (limit / 16))) {
      ends[k] = rim.distance;
      around.creases.push_back({d, rim.distance});
      around.to_crease = std::min(around.to_crease, rim.distance);
    }
  }
  const double least = std::min(limit, kLeastSize * largest_on(point));
  around.size = std::clamp(most_turn / std::max(curvature, 1e-30), least, limit);
  around.size =
      std::min(around.size, std::clamp(most_turn / std::max(fold, 1e-30),
                                       std::min(limit, kLeastAtFolds * largest_on(point)), limit));
  for (int k = 0; k < kDirections / 2; ++k) {
    const auto shortest = [&](int i) {
      return ends[i] <= ends[(i + 1) % kDirections] &&
             ends[i] <= ends[(i + kDirections - 1) % kDirections];
    };
    const double width = ends[k] + ends[k + kDirections / 2];
    if (std::isfinite(width) && shortest(k) && shortest(k + kDirections / 2)) {
      around.size = std::min(
          around.size, std::max(kStripWidths * width, std::min(limit, kLeastStrip * spacing_)));
    }
  }
  return around;
}

double CoverPoints::graded(const ZonePoint& point, double size) const {
  thread_local std::vector<std::uint32_t> ids;
  grid_.query(point.position, size / kGrading, 3, ids);
  for (const std::uint32_t id : ids) {
    const CoverPoint& q = points_[id];
    if (dot(q.normal, point.normal) < 0.5) continue;
    size = std::min(size, q.size + kGrading * distance(q.position, point.position));
  }
  return size;
}

bool CoverPoints::crowded(const ZonePoint& point, double size) const {
  thread_local std::vector<std::uint32_t> ids;
  grid_.query(point.position, kApart * size, 1, ids);
  return std::any_of(ids.begin(), ids.end(), [&](std::uint32_t id) {
    const CoverPoint& q = points_[id];
    const Vec3 d = q.position - point.position;
    const double apart = (q.on_crease() ? 0.75 : 1) * kApart * std::min(size, q.size);
    if (length_squared(d) >= apart * apart) return false;
    if (dot(q.normal, point.normal) < walk_.cos_normal_tolerance()) return false;
    // Of another sheet close by, where the height between them is not that of a curved surface.
    const double height = std::abs(dot(d, point.normal));
    if (height <= (length(q.normal - point.normal) + 1e-3) * length(d)) return true;
    const auto there = walk_.over(point, q.position);
    return there && distance(there->position, q.position) < 1e-3 * size;
  });
}

void CoverPoints::add(const CoverPoint& point, const Surroundings& around) {
  const auto id = static_cast<std::uint32_t>(points_.size());
  points_.push_back(point);
  surroundings_.push_back(around);
  surroundings_.back().creases.clear();
  along_crease_.emplace_back();
  grid_.insert(id, point.position, point.size);
  front_.push({point.size, id});
}

/// The largest size on the object of a point.
double CoverPoints::largest_on(const ZonePoint& point) const {
  const Object& object = walk_.rays().scene().objects[point.surface.object];
  return std::min(spacing_, 0.25 * object.shape->bounds().diagonal());
}

void CoverPoints::grow_from(const ZonePoint& point) {
  beyond_.push_back(point);
  for (std::size_t next = 0; next < beyond_.size() && going(); ++next) {
    const ZonePoint from = beyond_[next];
    offer(from, largest_on(from));
    spawn_all();
  }
  beyond_.clear();
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
  next_look_ = 0;
  const std::vector<CoverPoint> points = std::move(points_);
  const std::vector<Surroundings> around = std::move(surroundings_);
  const auto along = std::move(along_crease_);
  points_.clear(), surroundings_.clear(), along_crease_.clear();
  grid_ = GradedGrid(walk_.rays().scene().bounds().lower);

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
    while (!front_.empty() && front_.top().first < size) {
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
    offer(point, largest_on(point));
    spawn_all();
  }
}

void CoverPoints::offer(const ZonePoint& point, double limit) {
  if (crowded(point, limit)) return;
  const Frame frame(point.normal);
  const double angle = kTau * random_.uniform();
  const Vec3 first = frame.u * std::cos(angle) + frame.v * std::sin(angle);
  const Surroundings around = look_around(point, first, limit);
  for (const Ending& ending : around.creases) {
    if (ending.distance > 1.2 * around.size) continue;
    crease_seeds_.push_back({point, ending.direction, ending.distance, around.size});
  }
  run_creases();
  accept(point, around);
}

void CoverPoints::accept(const ZonePoint& point, const Surroundings& around) {
  const double size = graded(point, around.size);
  if (around.to_crease < kFromCrease * size || crowded(point, size)) return;
  CoverPoint accepted;
  static_cast<ZonePoint&>(accepted) = point;
  accepted.size = size;
  add(accepted, around);
}

void CoverPoints::spawn(std::uint32_t id) {
  constexpr int kTries = 14;
  const CoverPoint parent = points_[id];
  const Frame frame(parent.normal);
  const double first = kTau * random_.uniform();
  for (int k = 0; k < kTries; ++k) {
    const double angle = first + kTau * k / kTries;
    const double r = parent.size * (1 + 0.3 * random_.uniform());
    const Vec3 d = (frame.u * std::cos(angle) + frame.v * std::sin(angle)) * r;
    if (dot(d, parent.inward) < 0) continue;
    ZonePoint guess = parent;
    guess.position += d;
    if (crowded(guess, parent.size)) continue;
    const auto child = walk_.step(parent, guess.position);
    if (child) offer(*child, std::min(spacing_, 1.5 * parent.size));
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
