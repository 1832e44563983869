// The node graph of a glTF file as a flat list: every node of the scene that has a mesh, with its transform.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "meshprep/read/gltf_document.h"

namespace malus::prep {

struct GltfPlacement {
  std::size_t mesh = 0;
  std::string name;  // of the node; "node 3" where it has none
  glm::dmat4 worldFromObject{1.0};
};

// In the order of the graph, depth first. Adds notes about what is left out. Throws Error: an index of something that
// is not there, a node with two parents or below itself, a scene that names a node twice or one with a parent, a
// matrix whose last row is not (0, 0, 0, 1), a rotation without length, a transform of a mesh that flattens it or is
// not finite, more than `most` placements.
std::vector<GltfPlacement> gltfPlacements(const gltf::Document& document, std::size_t most, const std::string& where,
                                          std::vector<std::string>& notes);

}  // namespace malus::prep
