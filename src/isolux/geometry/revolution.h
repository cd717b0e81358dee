#pragma once

#include "isolux/geometry/crossings.h"
#include "isolux/geometry/profile.h"

namespace isolux {

/// How a profile becomes a surface.
struct RevolutionForm {
  double angle = 360;   ///< degrees, more than 0
  bool smooth = false;  ///< whether the profile is a curve through its points (profile_parts)
  bool open = false;    ///< the surface that the line itself passes over, as against the solid
};

/// A profile (r, z in m) turned about an axis, right-handed, from x as it lies across the axis
/// (from y where the axis is within 26° of x), its heights counted from `center`. Straight parts
/// are pieces of cones, cylinders and planes.
///
/// A solid's profile is closed as profile_parts() says; a straight one must not cross itself, and
/// what curves go around an odd number of times is inside. An open surface faces outward where its
/// profile runs up. Faces are those of the profile, then, of a solid with an angle below 360°, the
/// cut it starts from, and the other.
class Revolution final : public Shape {
 public:
  Revolution(const Vec3& center, const Vec3& axis, std::vector<ProfilePoint> profile,
             const RevolutionForm& form = {});

  Bounds bounds() const override { return bounds_; }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool solid() const override { return !form_.open; }
  bool contains(const Vec3& point) const override;
  std::uint32_t face_count() const override { return side_faces() + (cut() ? 2 : 0); }
  /// By Pappus' rule; not known for curves that are cut.
  std::optional<double> area() const override;
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

 private:
  struct Line;

  std::uint32_t side_faces() const { return parts_.back().face + 1; }
  bool cut() const { return !form_.open && form_.angle < 360; }
  Vec3 to_local(const Vec3& v) const {
    return {dot(v, frame_.u), dot(v, frame_.v), dot(v, frame_.n)};
  }
  bool within_angle(const Vec3& p) const;
  bool inside(const Vec3& p) const;
  void find_straight(std::uint32_t part, const Line& line, std::vector<Candidate>& found) const;
  void find_curved(std::uint32_t part, const Line& line, std::vector<Candidate>& found) const;
  void find_cuts(const Line& line, std::vector<Candidate>& found) const;
  Hit hit(const Line& line, const Candidate& candidate, bool entering) const;
  double part_area(const ProfilePart& part) const;
  TriangleSoup part_triangles(const ProfilePart& part, double max_edge) const;

  Vec3 given_center_, axis_;
  std::vector<ProfilePoint> profile_;  ///< as given
  RevolutionForm form_;
  Frame frame_;       ///< its third axis is that of the turn
  Vec3 center_;       ///< origin of the local frame, half way up the profile
  double unit_ = 1;   ///< m, the length of the local frame
  double angle_ = 0;  ///< rad
  std::vector<ProfilePart> parts_;
  TriangleSoup cut_;  ///< of a cut between straight parts, local, in y = 0
  Bounds bounds_;
};

}  // namespace isolux
