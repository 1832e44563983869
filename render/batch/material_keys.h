// Keys of a material that a frame may change.
#pragma once

#include "bake/pack/scene.h"
#include "bake/scene_file/strict_object.h"

namespace malus::render {

// Sets the fields whose keys the object has, and reads it to its end. wavelengthsNm: those of the frame, for presets.
// Throws Error: an unknown key, a value out of range, a key of another kind of material, a texture in its place.
void overrideMaterial(bake::StrictObject& object, const glm::dvec3& wavelengthsNm, pack::Material& material);

}  // namespace malus::render
