#include "isolux/radiosity/plain_progressive.h"

#include <utility>

#include "isolux/radiosity/elements.h"

namespace isolux {

std::vector<Rgb> plain_progressive_radiosity(const Triangulation& mesh,
                                             const Eigen::MatrixXd& factors,
                                             double stop_at_unshot) {
  const std::vector<Element> elements = elements_of(mesh);
  std::vector<Rgb> radiosity, unshot;
  double emitted = 0;
  for (const Element& element : elements) {
    radiosity.push_back(element.emission);
    unshot.push_back(element.emission);
    emitted += luminance(element.emission) * element.area;
  }
  const auto power = [&](std::size_t i) { return luminance(unshot[i]) * elements[i].area; };
  while (true) {
    std::size_t brightest = 0;
    double left = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      left += power(i);
      if (power(i) > power(brightest)) brightest = i;
    }
    if (left <= stop_at_unshot * emitted) return radiosity;

    const Rgb shot = std::exchange(unshot[brightest], Rgb{});
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const Rgb received =
          elements[i].reflectance * shot *
          factors(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(brightest));
      radiosity[i] += received;
      unshot[i] += received;
    }
  }
}

}  // namespace isolux
