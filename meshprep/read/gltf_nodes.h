// Objects that the nodes of a glTF scene place: meshes, cameras and lights, with their transforms.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "meshprep/read/gltf_document.h"
#include "meshprep/read/gltf_left_out.h"

namespace malus::prep {

struct GltfPlacement {
  std::size_t object = 0;  // index into the list of the document
  std::string name;        // name of the node, or "node 3"
  glm::dmat4 worldFromObject{1.0};
};

struct GltfPlacements {
  std::vector<GltfPlacement> meshes, cameras, lights;
};

// Returns the placements in depth-first order. Leaves out:
//   a mesh that does not exist or is invalid, or whose transform is singular or out of range (cameras and lights:
//   gltf_views.h)
//   a node and its descendants if its matrix has a last row other than (0, 0, 0, 1), its rotation has length 0, or one
//   of them has the wrong type
//   a child or root that does not exist, has another parent or is named before; the nodes of a cycle
// A default scene that does not exist is replaced by the first one. Adds notes about ignored content. Throws Error:
// more than `most` placements of meshes, or invalid children in a file without scenes, where the root nodes are
// unknown.
GltfPlacements gltfPlacements(const gltf::Document& document, std::size_t most, const std::string& where,
                              GltfLeftOut& leftOut);

}  // namespace malus::prep
