// An image without some of its effects.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

// Switches off the effects that parameters can switch off. Throws Error for a name that is not an effect.
void switchOff(const std::vector<std::string>& off, RenderParameters& parameters);

// Removes effects from an image: those that parameters can switch off there; the others from a copy of the scene, which
// is returned, or null if none needs it. Linear and circular polarization are left to the choice of the method. Throws
// Error for a name that is not an effect and for tir.
std::shared_ptr<const pack::Scene> leaveOut(const pack::Scene& scene, const std::vector<std::string>& off,
                                            RenderParameters& parameters);

}  // namespace malus::render
