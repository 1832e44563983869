// Which parts of the shaders a picture of a scene calls for: what Vulkan's variants and Embree's builds leave out.
#pragma once

#include <cstdint>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

// Bits of shaders::Effect; all of them where the view asks for every effect.
std::uint32_t compiledEffects(const pack::Scene& scene, const RenderParameters& parameters);

// Ways of an eye path that may wait at once in a loop (shaders/iterative/camera_path.h): one an interaction with glass,
// the facets of a rough surface; one place at least.
std::uint32_t pathStackSize(std::uint32_t effects, std::uint32_t depth);

}  // namespace malus::render
