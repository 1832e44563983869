// Emitting surfaces that light others, from the meshes of a scene: rectangles where two triangles make one, else
// triangles, and a binary tree of them by which samples are distributed (shaders/optics/area_light.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/pack/scene.h"
#include "shaders/gpu/scene.h"

namespace malus::render {

namespace precise {
using real = double;
using real3 = glm::dvec3;
using word = std::uint32_t;
#include "shaders/gpu/material.h"
}  // namespace precise

using precise::AreaLight;
using precise::LightNode;

struct AreaLights {
  std::vector<AreaLight> lights;
  std::vector<std::uint32_t> placements;  // index among pack::placements(), per light
  std::vector<LightNode> nodes;           // the root is the first; empty without lights
};

// Positions are relative to the scene's origin. The tree is balanced: its depth is the logarithm of the number of
// lights, rounded up. The same for the same scene.
AreaLights findAreaLights(const pack::Scene& scene);

struct AreaLightCount {
  std::size_t lights = 0;
  std::size_t levels = 0;  // nodes between the root and the deepest light
};
AreaLightCount countAreaLights(const pack::Scene& scene);

gpu::AreaLight toFloat(const AreaLight& light);
gpu::LightNode toFloat(const LightNode& node);

}  // namespace malus::render
