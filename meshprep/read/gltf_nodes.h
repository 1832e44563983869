// Objects that the nodes of a glTF scene place: meshes, cameras and lights, with their transforms.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "meshprep/read/gltf_buffers.h"
#include "meshprep/read/gltf_document.h"
#include "meshprep/read/gltf_left_out.h"

namespace malus::prep {

struct GltfPlacement {
  std::size_t object = 0;  // index into the list of the document
  std::string name;        // name of the node, or "node 3"
  glm::dmat4 worldFromObject{1.0};

  // Of a mesh. Those with a skin are placed by its joints: worldFromObject is the identity.
  std::vector<double> morphWeights = {};  // one per target; empty: all are 0
  std::optional<std::size_t> skin = {};
};

struct GltfPlacements {
  std::vector<GltfPlacement> meshes, cameras, lights;
  std::vector<std::optional<glm::dmat4>> worldFromNode;  // one per node; nothing: the node is not in the scene
};

// Returns the placements in depth-first order; a node with EXT_mesh_gpu_instancing places its mesh once per instance.
// Leaves out:
//   a mesh that does not exist or is invalid, or whose transform is singular or out of range (cameras and lights:
//   gltf_views.h), and one with an invalid skin or invalid instances
//   a mesh that is hidden by a scale of 0, also if strict, with a note of the number
//   a node and its descendants if its matrix has a last row other than (0, 0, 0, 1), its rotation has length 0, or one
//   of them has the wrong type
//   a child or root that does not exist, has another parent or is named before; the nodes of a cycle
// A default scene that does not exist is replaced by the first one. Adds notes about ignored content. Throws Error:
// more than `most` placements of meshes, or invalid children in a file without scenes, where the root nodes are
// unknown.
GltfPlacements gltfPlacements(const gltf::Document& document, GltfBuffers& buffers, std::size_t most,
                              const std::string& where, GltfLeftOut& leftOut);

}  // namespace malus::prep
