// Cameras and lights of a glTF document, from their placements.
#pragma once

#include <string>
#include <vector>

#include "meshprep/read/gltf_document.h"
#include "meshprep/read/gltf_left_out.h"
#include "meshprep/read/gltf_nodes.h"
#include "meshprep/read/source_view.h"

namespace malus::prep {

// A camera and a light look along the -z axis of their node, with +y up; scales of nodes do not change them.
// Leaves out each that does not exist, is of an unknown type, has values out of the range of the specification, or a
// node whose transform has no such axes.
// Source: glTF 2.0 Specification, section 3.10, "Cameras"; KHR_lights_punctual.
std::vector<SourceCamera> gltfCameras(const gltf::Document& document, const std::vector<GltfPlacement>& placements,
                                      const std::string& where, GltfLeftOut& leftOut);
std::vector<SourceLight> gltfLights(const gltf::Document& document, const std::vector<GltfPlacement>& placements,
                                    const std::string& where, GltfLeftOut& leftOut);

}  // namespace malus::prep
