#include "render/viewer/wish.h"

namespace malus::viewer {

namespace {

bool isSameCamera(const pack::Camera& a, const pack::Camera& b) {
  return a.position == b.position && a.forward == b.forward && a.up == b.up &&
         a.verticalFovDegrees == b.verticalFovDegrees && a.orthographicHeight == b.orthographicHeight;
}

render::Analyser renderedFilter(const Wish& wish, const SideSettings& side, const std::vector<pack::Effect>& needed) {
  return jobSettings(wish.state, side, wish.width, wish.height, needed).analyser;
}

}  // namespace

bool isSamePreparation(const Wish& before, const Wish& after, const std::vector<pack::Effect>& needed) {
  const ViewState &a = before.state, &b = after.state;
  if (before.width != after.width || before.height != after.height || a.isSplit != b.isSplit || a.depth != b.depth ||
      a.samples != b.samples || a.lightSamples != b.lightSamples)
    return false;
  for (std::size_t i = 0; i < (b.isSplit ? 2u : 1u); ++i)
    if (!(a.sides[i] == b.sides[i]) ||
        renderedFilter(before, a.sides[i], needed) != renderedFilter(after, b.sides[i], needed))
      return false;
  return true;
}

bool needsRender(const Wish& before, const Wish& after, const std::vector<pack::Effect>& needed) {
  return !isSameCamera(before.state.camera, after.state.camera) ||
         before.state.isContinuous != after.state.isContinuous || !isSamePreparation(before, after, needed);
}

}  // namespace malus::viewer
