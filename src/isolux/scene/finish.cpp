#include "isolux/scene/finish.h"

#include <fmt/format.h>

#include <tuple>

#include "isolux/core/error.h"
#include "isolux/geometry/face_selection.h"

namespace isolux {
namespace {

const FaceSelection* selection_of(const Object& object) {
  return dynamic_cast<const FaceSelection*>(object.shape.get());
}

}  // namespace

std::vector<Object> split_by_finish(const Object& object, const std::vector<FaceRun>& runs) {
  constexpr std::size_t kMostParts = 100;
  if (runs.empty()) return {object};
  struct Part {
    Finish finish;
    std::vector<FaceRange> faces;
  };
  std::vector<Part> parts;
  std::map<std::tuple<std::uint32_t, double, double, double>, std::size_t> numbers;
  std::uint32_t face = 0;
  for (const FaceRun& run : runs) {
    const Finish finish = run.finish.value_or(Finish{object.material, object.exitance});
    const Rgb& e = finish.exitance;
    const auto number = numbers.try_emplace({finish.material, e.r, e.g, e.b}, parts.size());
    if (number.second) parts.push_back({finish, {}});
    if (parts.size() > kMostParts) {
      throw InputError(fmt::format(
          "the parts of an object look different in more than {} ways: make several objects",
          kMostParts));
    }
    std::vector<FaceRange>& faces = parts[number.first->second].faces;
    if (!faces.empty() && faces.back().end == face) {
      faces.back().end += run.count;
    } else {
      faces.push_back({face, face + run.count});
    }
    face += run.count;
  }
  std::vector<Object> objects;
  for (Part& part : parts) {
    Object& shown = objects.emplace_back(object);
    shown.material = part.finish.material;
    shown.exitance = part.finish.exitance;
    if (parts.size() == 1) break;
    shown.shape = std::make_shared<FaceSelection>(object.shape, std::move(part.faces));
    if (objects.size() > 1) shown.name += fmt::format(", part {}", objects.size());
  }
  return objects;
}

std::size_t count_split(const std::vector<Object>& objects, std::size_t first) {
  const FaceSelection* const selection = selection_of(objects[first]);
  std::size_t end = first + 1;
  for (; selection && end < objects.size(); ++end) {
    const FaceSelection* const next = selection_of(objects[end]);
    const bool belongs = next && next->whole() == selection->whole();
    if (!belongs || next->shown().front().first == 0) break;  // only the first has face 0
  }
  return end - first;
}

FinishOfFaces::FinishOfFaces(std::span<const Object> split)
    : own_{split.front().material, split.front().exitance} {
  for (const Object& object : split) {
    const auto& selection = dynamic_cast<const FaceSelection&>(*object.shape);
    whole_ = selection.whole();
    for (const FaceRange& range : selection.shown()) {
      runs_[range.first] = {range.end - range.first, Finish{object.material, object.exitance}};
    }
  }
}

std::optional<Finish> FinishOfFaces::all(std::uint32_t first, std::uint32_t count) const {
  const auto& [start, run] = *std::prev(runs_.upper_bound(first));
  return first - start + count <= run.count ? run.finish : std::nullopt;
}

}  // namespace isolux
