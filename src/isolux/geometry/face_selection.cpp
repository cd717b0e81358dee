#include "isolux/geometry/face_selection.h"

#include <algorithm>

#include "isolux/geometry/shape_description.h"

namespace isolux {

bool FaceSelection::shows(std::uint32_t face) const {
  const auto after =
      std::upper_bound(shown_.begin(), shown_.end(), face,
                       [](std::uint32_t f, const FaceRange& r) { return f < r.end; });
  return after != shown_.end() && face >= after->first;
}

void FaceSelection::intersect(const Ray& ray, Hits& hits) const {
  const auto first = static_cast<std::ptrdiff_t>(hits.size());
  whole_->intersect(ray, hits);
  const auto hidden = [&](const Hit& hit) { return !shows(hit.face); };
  hits.erase(std::remove_if(hits.begin() + first, hits.end(), hidden), hits.end());
}

ShapeDescription FaceSelection::describe() const { return whole_->describe(); }

}  // namespace isolux
