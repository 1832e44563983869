#include "bake/model/framing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace malus::bake {

FramingView frameBox(const glm::dvec3& low, const glm::dvec3& high, double aspect) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double a = kFramingAzimuthDegrees * kDegree, e = kFramingElevationDegrees * kDegree;
  const glm::dvec3 toCamera(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a));
  const glm::dvec3 right(std::cos(a), 0, -std::sin(a)), up = glm::cross(toCamera, right);
  const double tanY = std::tan(kFramingFovDegrees / 2 * kDegree) * (1 - kFramingMargin), tanX = tanY * aspect;

  // A corner at c from the centre is in the image if |c . right| <= tanX (distance - c . toCamera), and the same with
  // up.
  const glm::dvec3 centre = low + (high - low) * 0.5, half = (high - low) * 0.5;
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 c((i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                       (i & 4) != 0 ? half.z : -half.z);
    const double before = glm::dot(c, toCamera);
    distance =
        std::max({distance, before + std::abs(glm::dot(c, right)) / tanX, before + std::abs(glm::dot(c, up)) / tanY});
  }
  return {centre + toCamera * distance, centre};
}

}  // namespace malus::bake
