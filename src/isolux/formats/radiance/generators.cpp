#include "isolux/formats/radiance/generators.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "isolux/formats/radiance/expression.h"
#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace {

using std::numbers::pi;

double positive(const Statement& s, std::size_t i) {
  const double value = s.number(i);
  if (!(value > 0)) s.fail(i, fmt::format("must be more than 0, but is {}", value));
  return value;
}

[[noreturn]] void unknown_option(const Statement& s, std::size_t i) {
  throw Unsupported{fmt::format("the option {}", in_quotes(s.word(i)))};
}

/// The word after option i, which must be there.
std::size_t argument(const Statement& s, std::size_t i) {
  if (i + 1 == s.size()) s.fail(i, fmt::format("{} needs a number", in_quotes(s.word(i))));
  return i + 1;
}

/// A box from the origin to `size`, its surfaces facing outward or inward.
struct BoxMaker {
  Vec3 size;
  double inset;  ///< of the flat faces, from the edges
  bool inward;
  std::vector<Surface> surfaces;

  /// The corner on the upper side of the axes whose bits are set, moved inward along those of
  /// `moved`.
  Vec3 corner(unsigned upper, unsigned moved) const {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const double by = (moved >> axis & 1) ? inset : 0;
      p[axis] = (upper >> axis & 1) ? size[axis] - by : by;
    }
    return p;
  }
  void add(std::vector<Vec3> corners) {
    const Vec3 normal = doubled_area(corners);
    const bool outward = dot(normal, corners[0] - size * 0.5) > 0;
    if (outward == inward) std::reverse(corners.begin(), corners.end());
    surfaces.push_back(polygon(corners));
  }
};

void add_faces(BoxMaker& box) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned a = 1u << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
    for (const unsigned side : {0u, a}) {
      const unsigned moved = u | v;
      box.add({box.corner(side, moved), box.corner(side | u, moved),
               box.corner(side | u | v, moved), box.corner(side | v, moved)});
    }
  }
}

void add_bevels(BoxMaker& box) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned a = 1u << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
    for (const unsigned side : {0u, u, v, u | v}) {
      box.add({box.corner(side, a | u), box.corner(side | a, a | u), box.corner(side | a, a | v),
               box.corner(side, a | v)});
    }
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    box.add({box.corner(corner, 6), box.corner(corner, 5), box.corner(corner, 3)});
  }
}

void add_rounding(BoxMaker& box) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned a = 1u << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
    for (const unsigned side : {0u, u, v, u | v}) {
      box.surfaces.push_back(
          {placed_tube(box.corner(side, 7), box.corner(side | a, 7), box.inset, box.inset)});
    }
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    box.surfaces.push_back({placed_ball(box.corner(corner, 7), box.inset)});
  }
}

}  // namespace

std::vector<Surface> generate_box(const Statement& s, Surroundings& around) {
  s.expect_arguments(5, Statement::kAnyNumber, "genbox modifier name x y z");
  BoxMaker box{{positive(s, 3), positive(s, 4), positive(s, 5)}, 0, false, {}};
  bool round = false;
  for (std::size_t i = 6; i < s.size(); ++i) {
    const std::string_view option = s.word(i);
    if (option == "-i") {
      box.inward = true;
    } else if (option == "-r" || option == "-b") {
      round = option == "-r";
      i = argument(s, i);
      box.inset = positive(s, i);
      if (2 * box.inset > (1 + 1e-9) * std::min({box.size.x, box.size.y, box.size.z})) {
        s.fail(i, "the edges take more than the whole box: at most half of its least size");
      }
    } else if (option == "-n") {
      i = argument(s, i);  // how finely to cut what stays round here
    } else if (option != "-s") {
      unknown_option(s, i);
    }
  }
  if (round && box.inward) {
    around.notes.changed("genbox -i -r", "edges that are round from within stay sharp");
    box.inset = 0;
  }
  add_faces(box);
  if (box.inset > 0) round ? add_rounding(box) : add_bevels(box);
  return std::move(box.surfaces);
}

namespace {

/// A prism over a polygon in the xy plane.
struct PrismMaker {
  std::vector<Vec3> corners;
  Vec3 along{0, 0, 1};
  double radius = 0;  ///< of rounded edges
  bool ends = true;
  bool complete = false;  ///< the polygon's last side is left open
  std::vector<Surface> surfaces;

  std::size_t sides() const { return corners.size() - (complete ? 1 : 0); }
  std::size_t before(std::size_t i) const { return (i > 0 ? i : corners.size()) - 1; }
  void add_sharp();
  void add_round();
};

void PrismMaker::add_sharp() {
  if (ends) {
    std::vector<Vec3> top;
    for (const Vec3& p : corners) top.push_back(p + along);
    std::reverse(top.begin(), top.end());
    surfaces.push_back(polygon(corners));
    surfaces.push_back(polygon(top));
  }
  for (std::size_t i = 0; i < sides(); ++i) {
    const Vec3 &p = corners[i], &q = corners[(i + 1) % corners.size()];
    surfaces.push_back(polygon({p, p + along, q + along, q}));
  }
}

/// With edges rolled off by balls that touch the faces from inside.
void PrismMaker::add_round() {
  const std::size_t n = corners.size();
  const double r = along.z < 0 ? -radius : radius;
  // Of each side, the direction back to where it starts; of each corner, where its ball touches
  // the sides, in radii from the corner: less than 0 where the corner is concave.
  std::vector<Vec3> back(n), centers(n);
  std::vector<double> trims(n);
  for (std::size_t i = 0; i < n; ++i) back[i] = normalized(corners[before(i)] - corners[i]);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &in = back[i], &out = back[(i + 1) % n];
    trims[i] = std::tan(0.5 * std::atan2(cross(out, in).z, dot(in, out)));
    if (!(std::abs(trims[i]) < 1e6))
      throw InputError("two sides of the prism fold onto each other");
    centers[i] = corners[i] + (in * trims[i] + cross({0, 0, 1}, in)) * r;
  }
  const Vec3 low{0, 0, r}, high = along - low;
  const auto bar = [&](const Vec3& a, const Vec3& b) {
    surfaces.push_back({placed_tube(a, b, radius, radius)});
  };
  if (ends) {
    std::vector<Vec3> top;
    for (const Vec3& p : centers) top.push_back(p + along);
    std::reverse(top.begin(), top.end());
    surfaces.push_back(polygon(centers));
    surfaces.push_back(polygon(top));
    for (const Vec3& height : {low, high}) {
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 center = centers[i] + height;
        if (trims[i] * r > 0) surfaces.push_back({placed_ball(center, radius)});
        bar(centers[before(i)] + height, center);
      }
    }
  }
  for (std::size_t i = 0; i < sides(); ++i) {
    const std::size_t k = (i + 1) % n;
    // Where the prism leans, its sides touch the balls higher or lower.
    const Vec3 tilted = cross(back[k], high - low);
    const double lean = (r < 0 ? -1 : 1) * tilted.z / length(tilted);
    const Vec3 out = cross(back[k], {0, 0, 1});
    const Vec3 shift = Vec3{0, 0, lean} + out * (std::sqrt(1 - lean * lean) - 1);
    const Vec3 p = corners[i] + (shift - back[k] * trims[i]) * r;
    const Vec3 q = corners[k] + (shift + back[k] * trims[k]) * r;
    surfaces.push_back(polygon({p + low, p + high, q + high, q + low}));
    if (trims[k] * r >= 0) bar(centers[k] + low, centers[k] + high);
  }
}

/// The x and y of all corners, as numbers of a statement from word `first` on.
void read_corners(const Statement& s, std::size_t first, std::size_t end, PrismMaker& prism) {
  for (std::size_t i = first; i + 1 < end; i += 2) {
    prism.corners.push_back({s.number(i), s.number(i + 1), 0});
  }
}

/// Reads the corners that word 3 on tells of; returns the place of the first option.
std::size_t read_corners(const Statement& s, Includes& includes, PrismMaker& prism) {
  constexpr int kMostCorners = 1000;
  const std::string_view source = s.word(3);
  if (source == "-") throw Unsupported{"what another program writes (-)"};
  if (!source.empty() && source[0] >= '0' && source[0] <= '9') {
    const auto count = static_cast<std::size_t>(s.integer(3, 3, kMostCorners));
    s.expect_arguments(3 + 2 * count, Statement::kAnyNumber, "x and y of every corner");
    read_corners(s, 4, 4 + 2 * count, prism);
    return 4 + 2 * count;
  }
  SourceText file;
  try {
    file = includes.open(source);
  } catch (const InputError& error) {
    s.fail(3, error.what());
  }
  includes.close();
  Scanner scanner(file);
  std::vector<Statement::Word> words;
  while (const auto word = scanner.word()) {
    if (words.size() == 2 * kMostCorners)
      s.fail(3, fmt::format("this file has more than {} corners", kMostCorners));
    words.push_back(*word);
  }
  const Statement numbers(file.file, std::move(words));
  read_corners(numbers, 0, numbers.size(), prism);
  if (prism.corners.size() < 3) s.fail(3, "this file has fewer than 3 corners, of x and y each");
  return 4;
}

}  // namespace

std::vector<Surface> generate_prism(const Statement& s, Surroundings& around) {
  s.expect_arguments(3, Statement::kAnyNumber, "genprism modifier name N x1 y1 ... xN yN");
  PrismMaker prism;
  for (std::size_t i = read_corners(s, around.includes, prism); i < s.size(); ++i) {
    const std::string_view option = s.word(i);
    if (option == "-l") {
      if (i + 3 >= s.size()) s.fail(i, "'-l' needs 3 numbers");
      prism.along = {s.number(i + 1), s.number(i + 2), s.number(i + 3)};
      if (!(std::abs(prism.along.z) > 1e-6)) s.fail(i + 3, "the prism needs a height");
      i += 3;
    } else if (option == "-r") {
      i = argument(s, i);
      prism.radius = s.number_of_at_least_0(i);
    } else if (option == "-e") {
      prism.ends = !prism.ends;
    } else if (option == "-c") {
      prism.complete = !prism.complete;
    } else {
      unknown_option(s, i);
    }
  }
  if (prism.radius > std::abs(prism.along.z)) {
    throw InputError("the edges of the prism are rounder than it is high");
  }
  prism.radius > 0 ? prism.add_round() : prism.add_sharp();
  return std::move(prism.surfaces);
}

std::vector<Surface> generate_blinds(const Statement& s, Surroundings&) {
  s.expect_arguments(7, 9, "genblinds modifier name depth width height slats angle [-r radius]");
  constexpr int kMostSlats = 10'000;
  constexpr double kStrip = 3 * pi / 180;  ///< most of the arc that a flat strip stands for
  const double depth = positive(s, 3), width = positive(s, 4), height = positive(s, 5);
  const int slats = s.integer(6, 1, kMostSlats);
  const double angle = s.number(7) * pi / 180;
  // Where the strips of a slat begin and end: on the chord, or on an arc that hangs below it (-r)
  // or rises above (+r).
  const Vec3 along{std::cos(angle), 0, std::sin(angle)}, up{-along.z, 0, along.x};
  std::vector<Vec3> profile{{}, along * depth};
  if (s.size() > 8) {
    if (s.word(8) != "-r" && s.word(8) != "+r") unknown_option(s, 8);
    const double radius = std::abs(s.number(argument(s, 8)));
    const double side = (s.word(8) == "-r") == (s.number(9) > 0) ? 1 : -1;
    if (radius > 0 && 2 * radius < depth) s.fail(9, "the radius must be at least half the depth");
    if (radius > 0) {
      const double half = std::asin(std::min(1.0, 0.5 * depth / radius));
      const int strips = static_cast<int>(std::ceil(2 * half / kStrip - 1e-5));
      const Vec3 center = along * (0.5 * depth) + up * (side * radius * std::cos(half));
      profile.clear();
      for (int i = 0; i <= strips; ++i) {
        const double at = half * (2.0 * i / strips - 1);
        profile.push_back(center + (along * std::sin(at) - up * (side * std::cos(at))) * radius);
      }
    }
  }
  std::vector<Surface> surfaces;
  const Vec3 across{0, width, 0};
  for (int slat = 0; slat < slats; ++slat) {
    const Vec3 base{0, 0, height * (slat + 0.5) / slats};
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      const Vec3 p = profile[i] + base, q = profile[i + 1] + base;
      surfaces.push_back(polygon({p, p + across, q + across, q}));
    }
  }
  return surfaces;
}

}  // namespace isolux::radiance
