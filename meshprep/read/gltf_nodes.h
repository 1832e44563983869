// Objects that the nodes of a glTF scene place: meshes, cameras and lights, with their transforms.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "meshprep/base/error.h"
#include "meshprep/read/gltf_document.h"

namespace malus::prep {

struct GltfPlacement {
  std::size_t object = 0;  // index into the list of the document
  std::string name;        // name of the node, or "node 3"
  glm::dmat4 worldFromObject{1.0};
};

struct GltfPlacements {
  std::vector<GltfPlacement> meshes, cameras, lights;
};

// Returns the placements in depth-first order. Adds notes about ignored content. Calls leaveOut(error) for a node whose
// mesh does not exist or whose transform is singular or out of range (cameras and lights: gltf_views.h), and for a node
// and its descendants if its matrix has a last row other than (0, 0, 0, 1) or its rotation has length 0. Throws Error:
// a node or scene that does not exist, a node with two parents, a cycle, a scene with a duplicate node or one that has
// a parent, more than `most` placements of meshes.
GltfPlacements gltfPlacements(const gltf::Document& document, std::size_t most, const std::string& where,
                              std::vector<std::string>& notes, const std::function<void(const Error&)>& leaveOut);

}  // namespace malus::prep
