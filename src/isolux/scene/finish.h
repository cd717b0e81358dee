#pragma once

#include <map>
#include <span>

#include "isolux/scene/scene.h"

namespace isolux {

/// What a part of an object looks like.
struct Finish {
  std::uint32_t material = 0;  ///< index into Scene::materials
  Rgb exitance;                ///< lm/m²

  bool operator==(const Finish&) const = default;
};

/// So many faces of a shape, on from those before, that have a finish of their own; or that of the
/// object.
struct FaceRun {
  std::uint32_t count = 0;
  std::optional<Finish> finish;
};

/// The object, or where its parts look different, one for each finish, which shows the faces that
/// have it; the runs name all faces of the shape, in their order, or there are none. Each of these
/// objects costs a ray as much as the whole: throws InputError, without a place, where there would
/// be more than 100.
std::vector<Object> split_by_finish(const Object& object, const std::vector<FaceRun>& runs);

/// How many objects from number `first` on are one that was split; 1 where it was not.
std::size_t count_split(const std::vector<Object>& objects, std::size_t first);

/// The way back: the finish of each face of an object that was split.
class FinishOfFaces {
 public:
  explicit FinishOfFaces(std::span<const Object> split);

  /// The shape that all of them show faces of.
  const std::shared_ptr<const Shape>& whole() const { return whole_; }
  /// That of the first object.
  const Finish& own() const { return own_; }
  /// The finish of these faces; nothing where they differ.
  std::optional<Finish> all(std::uint32_t first, std::uint32_t count) const;

 private:
  std::shared_ptr<const Shape> whole_;
  Finish own_;
  std::map<std::uint32_t, FaceRun> runs_;  ///< by the first face of each
};

}  // namespace isolux
