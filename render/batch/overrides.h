// Materials, lights, environment and wavelengths of a frame in place of those of the pack.
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/scene.h"
#include "bake/scene_file/strict_object.h"

namespace malus::render {

// The parts of a scene that a frame may change.
struct SceneSurfaces {
  glm::dvec3 wavelengthsNm;
  std::vector<pack::Material> materials;
  std::vector<pack::LightSource> lights;
  double environmentRotationDegrees = 0;  // counter-clockwise about +y seen from above, beside that of the bake
};

// Reads the keys wavelengthsNm, materials, lights and environment of a frame. The keys of a material are those of
// scene.json (bake/SCENE.md), except those of files, of axes and of the kind. Throws Error: an unknown material or key,
// a value out of range, a constant in whose place the pack has a texture, wavelengths at which the pack does not know
// the index of a material.
SceneSurfaces readSurfaces(bake::StrictObject& frame, const pack::Scene& scene);

}  // namespace malus::render
