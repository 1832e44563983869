#include "render/polarization_probe.h"

#include <algorithm>

#include "render/compare/image_error.h"
#include "render/job.h"
#include "render/make_renderer.h"
#include "render/scene/methods.h"

namespace malus::render {

bake::PolarizationProbe probePolarization(const pack::Scene& scene) {
  constexpr std::uint32_t kSide = 64;
  JobSettings settings;
  (scene.width >= scene.height ? settings.width : settings.height) =
      std::min(kSide, std::max(scene.width, scene.height));
  settings.tolerance = 1e-4;
  const RenderParameters parameters = renderParameters(settings, scene);
  const MethodInfo& complete = completeIterativeMethod();
  const std::unique_ptr<Renderer> renderer = makeRenderer(Backend::embree, scene, {});
  const ImageError error = imageError(renderer->render(complete.withoutLinear, parameters),
                                      renderer->render(complete.name, parameters), scene.exposureEv);
  return {parameters.width, parameters.height, error.relRms, error.shareOver1Percent};
}

}  // namespace malus::render
