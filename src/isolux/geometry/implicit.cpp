#include "isolux/geometry/implicit.h"

#include "isolux/core/error.h"
#include "isolux/geometry/bracketed_root.h"
#include "isolux/geometry/crossings.h"
#include "isolux/geometry/shape_description.h"

namespace isolux {
namespace {

constexpr std::size_t kMostPieces = 256;  ///< of a line, undecided at a time
constexpr double kShortest = 1e-10;       ///< piece of a line, of the box's size

/// The function along the line o + s d.
class AlongLine {
 public:
  AlongLine(const Expression& function, const Ray& line) : function_(function), line_(line) {}

  Dual<Enclosure> over(const Enclosure& s) const {
    std::array<Dual<Enclosure>, 3> variables;
    for (int i = 0; i < 3; ++i) {
      variables[i] = {line_.origin[i] + line_.direction[i] * s, line_.direction[i]};
    }
    return function_(variables);
  }
  ValueAndSlope at(double s) const {
    std::array<Dual<double>, 3> variables;
    for (int i = 0; i < 3; ++i) {
      variables[i] = {line_.origin[i] + line_.direction[i] * s, line_.direction[i]};
    }
    const auto [value, slope] = function_(variables);
    return {value, slope};
  }

 private:
  const Expression& function_;
  const Ray& line_;
};

/// Whether the function surely has one sign over the piece, by its range or that of its slope.
bool has_one_sign(const AlongLine& f, const Enclosure& piece, const Dual<Enclosure>& range) {
  if (!range.value.holds(0)) return true;
  const double middle = 0.5 * (piece.lo + piece.hi);
  return !(f.over(middle).value + range.slope * (piece - Enclosure(middle))).holds(0);
}

/// Adds the places in [from, to] where the function changes its sign.
void add_roots(const AlongLine& f, double from, double to, std::vector<Candidate>& candidates) {
  thread_local std::vector<Enclosure> pieces, halves;
  pieces.assign(1, {from, to});
  for (double width = to - from; !pieces.empty(); width *= 0.5) {
    const bool last = width < kShortest || pieces.size() > kMostPieces;
    halves.clear();
    for (const Enclosure& piece : pieces) {
      const Dual<Enclosure> range = f.over(piece);
      if (has_one_sign(f, piece, range)) continue;
      if (last || !range.slope.holds(0)) {
        const bool rising = f.at(piece.lo).value < 0;
        if (rising == (f.at(piece.hi).value < 0)) continue;
        const auto value = [&](double s) { return f.at(s); };
        candidates.push_back({bracketed_root(value, piece.lo, piece.hi, rising), 2});
      } else {
        const double middle = 0.5 * (piece.lo + piece.hi);
        halves.push_back({piece.lo, middle});
        halves.push_back({middle, piece.hi});
      }
    }
    pieces.swap(halves);
  }
}

}  // namespace

Implicit::Implicit(Expression function, const Vec3& lower, const Vec3& upper)
    : function_(std::move(function)),
      box_(lower, upper),
      center_(box_.bounds().center()),
      unit_(0.5 * box_.bounds().diagonal()) {
  if (range(bounds()).lo >= 0) {
    throw InputError("function: must be negative somewhere in the box, but is nowhere");
  }
}

ShapeDescription Implicit::describe() const {
  return {"implicit",
          {{"function", std::string_view(function_.text())},
           {"lower", box_.bounds().lower},
           {"upper", box_.bounds().upper}},
          {},
          {}};
}

Enclosure Implicit::range(const Bounds& box) const {
  std::array<Dual<Enclosure>, 3> variables;
  for (int i = 0; i < 3; ++i) variables[i].value = {box.lower[i], box.upper[i]};
  return function_(variables).value;
}

bool Implicit::negative(const Vec3& point) const {
  return function_(std::array<Dual<double>, 3>{{{point.x}, {point.y}, {point.z}}}).value < 0;
}

Vec3 Implicit::outward(const Vec3& point, const Vec3& otherwise) const {
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<Dual<double>, 3> variables{{{point.x}, {point.y}, {point.z}}};
    variables[axis].slope = 1;
    gradient[axis] = function_(variables).slope;
  }
  const double size = length(gradient);
  return size > 0 && std::isfinite(size) ? gradient / size : otherwise;
}

void Implicit::intersect(const Ray& ray, Hits& hits) const {
  const double speed = length(ray.direction);
  const Vec3 d = ray.direction / speed;
  const double shift = dot(center_ - ray.origin, d);
  const Ray line{ray.origin + d * shift, d * unit_};

  thread_local Hits ends;
  ends.clear();
  box_.intersect(line, ends);
  if (ends.size() != 2) return;
  thread_local std::vector<Candidate> candidates;
  candidates = {{ends[0].t, 0}, {ends[1].t, 1}};
  add_roots(AlongLine(function_, line), ends[0].t, ends[1].t, candidates);

  const auto inside = [&](double s) { return negative(line.at(s)); };
  const auto hit = [&](const Candidate& c, bool enters) {
    const double t = (shift + c.s * unit_) / speed;
    if (c.face < 2) return Hit{t, ends[c.face].point, ends[c.face].normal, ends[c.face].face};
    const Vec3 point = line.at(c.s);
    return Hit{t, point, outward(point, enters ? Vec3{} - d : d), 6};
  };
  append_crossings(candidates, d, inside, hit, hits);
}

bool Implicit::avoids(const Bounds& box) const {
  const Bounds own = bounds();
  if (!own.overlaps(box)) return true;
  const Enclosure f = range({max(own.lower, box.lower), min(own.upper, box.upper)});
  return f.lo > 0 || (f.hi < 0 && own.encloses(box));
}

bool Implicit::contains(const Vec3& point) const { return box_.contains(point) && negative(point); }

}  // namespace isolux
