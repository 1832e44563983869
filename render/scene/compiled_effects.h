// Parts of the shaders that an image of a scene needs: the variants of the Vulkan renderer and the builds of the Embree
// renderer omit the others.
#pragma once

#include <cstdint>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

// Bits of shaders::Effect; all of them if parameters.everyEffect is set.
std::uint32_t compiledEffects(const pack::Scene& scene, const RenderParameters& parameters);

// Whether light passes polarizing elements and thin glass on its way to the surfaces of the scene.
bool filtersShadows(const pack::Scene& scene, const RenderParameters& parameters);

// Most paths that an iterative method defers at once (shaders/iterative/camera_path.h): one per interaction with glass,
// and the facets of one rough surface; at least 1.
std::uint32_t pathStackSize(std::uint32_t effects, std::uint32_t depth);

}  // namespace malus::render
