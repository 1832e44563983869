#include "render/scene/compiled_effects.h"

#include <algorithm>

#include "bake/effects/effects.h"
#include "render/scene/render_scene.h"
#include "shaders/effects.h"
#include "shaders/gpu/constants.h"

namespace malus::render {

using shaders::Effect;

namespace {

// Effects of data that a scene has or lacks: sampled lights, filters before lights, maps, instances and layers of
// materials. Without the data their code cannot run, but it is most of the code of a variant, which a CPU takes minutes
// to compile.
constexpr std::uint32_t kOfData =
    shaders::effectBit(Effect::kAreaLights) | shaders::effectBit(Effect::kEnvironmentLight) |
    shaders::effectBit(Effect::kFilteredShadows) | shaders::effectBit(Effect::kMeshTextures) |
    shaders::effectBit(Effect::kNormalMaps) | shaders::effectBit(Effect::kCutOuts) |
    shaders::effectBit(Effect::kInstances) | shaders::effectBit(Effect::kSpecularFactors) |
    shaders::effectBit(Effect::kTintedGlass) | shaders::effectBit(Effect::kClearCoats);

std::uint32_t neededEffects(const pack::Scene& scene, const RenderParameters& parameters) {
  return bake::findCompiledEffects(scene, {parameters.depth, parameters.analyser, false, false});
}

}  // namespace

std::uint32_t compiledEffects(const pack::Scene& scene, const RenderParameters& parameters) {
  std::uint32_t needed = neededEffects(scene, parameters);
  if (parameters.everyEffect) needed |= shaders::kEveryEffect & ~kOfData;
  if (!parameters.shadows) needed &= ~shaders::effectBit(Effect::kShadows);
  if (!filtersShadows(scene, parameters)) needed &= ~shaders::effectBit(Effect::kFilteredShadows);
  return needed;
}

bool filtersShadows(const pack::Scene& scene, const RenderParameters& parameters) {
  return parameters.shadows && parameters.filteredShadows &&
         (neededEffects(scene, parameters) & shaders::effectBit(Effect::kFilteredShadows)) != 0;
}

std::uint32_t pathStackSize(std::uint32_t effects, std::uint32_t depth) {
  std::uint32_t branching = 0;  // kinds of surface that reflect and transmit
  for (const pack::MaterialKindInfo& kind : pack::kMaterialKinds)
    if (pack::isClear(kind.kind)) branching |= 1u << surfaceKind(kind.kind);
  std::uint32_t size = (effects & branching) != 0 ? std::max(depth, 1u) : 1;
  if ((effects & shaders::effectBit(Effect::kRoughness)) != 0) size += gpu::kFacets;
  return size;
}

}  // namespace malus::render
