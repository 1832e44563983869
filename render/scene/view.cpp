#include "render/scene/view.h"

#include <cmath>
#include <numbers>

namespace malus::render {

Analyser linearPolarizer(double degrees) {
  const double twice = 2 * std::fmod(degrees, 180.0) * std::numbers::pi / 180;
  return {0.5, 0.5 * std::cos(twice), 0.5 * std::sin(twice), 0};
}

View viewOf(const pack::Scene& scene) {
  View view;
  view.width = scene.width;
  view.height = scene.height;
  view.region = {0, 0, scene.width, scene.height};
  view.depth = scene.depth;
  return view;
}

}  // namespace malus::render
