// Instances of a glTF file: the nodes of the scene that have a mesh, with their transforms.
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
  std::size_t mesh = 0;
  std::string name;  // name of the node, or "node 3"
  glm::dmat4 worldFromObject{1.0};
};

// Returns the placements in depth-first order. Adds notes about ignored content. Calls leaveOut(error) for a node whose
// mesh does not exist or whose transform is singular or out of range, and for a node and its descendants if its matrix
// has a last row other than (0, 0, 0, 1) or its rotation has length 0. Throws Error: a node or scene that does not
// exist, a node with two parents, a cycle, a scene with a duplicate node or one that has a parent, more than `most`
// placements.
std::vector<GltfPlacement> gltfPlacements(const gltf::Document& document, std::size_t most, const std::string& where,
                                          std::vector<std::string>& notes,
                                          const std::function<void(const Error&)>& leaveOut);

}  // namespace malus::prep
