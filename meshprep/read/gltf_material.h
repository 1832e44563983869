// Materials of glTF 2.0: metallic-roughness, emission, and the extensions KHR_materials_ior, _transmission, _volume
// and _emissive_strength.
//
// An index of 0, which KHR_materials_ior keeps for old ways of shading, is taken as 1.5. An attenuation distance
// without a volume's thickness counts too: meshes here have an inside. What is left out leaves a note.
#pragma once

#include <string>
#include <vector>

#include "meshprep/read/gltf_document.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {

// place: "file: materials[0]". Throws Error: a number out of the bounds that glTF and its extensions give.
SourceMaterial gltfMaterial(const gltf::Material& material, const std::string& place, std::vector<std::string>& notes);

}  // namespace malus::prep
