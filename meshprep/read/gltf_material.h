// Materials of glTF 2.0: metallic-roughness, emission, and the extensions KHR_materials_ior, _transmission, _volume,
// _specular, _iridescence, _clearcoat, _emissive_strength and _pbrSpecularGlossiness.
//
// An attenuation distance is used without a thickness too, because meshes are closed. Emissive factors above 1, which
// exporters wrote before KHR_materials_emissive_strength, are accepted with a note. Ignored content leaves a note.
#pragma once

#include <string>
#include <vector>

#include "meshprep/read/gltf_document.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {

// location: "materials[0]". A number out of the range of glTF and its extensions is clamped with a note, or replaced by
// the default if the range has no end; if `strict` it is an Error.
SourceMaterial gltfMaterial(const gltf::Document& document, const gltf::Material& material, const std::string& location,
                            std::vector<std::string>& notes, bool strict = false);

}  // namespace malus::prep
