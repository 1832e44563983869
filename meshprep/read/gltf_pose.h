// The default pose of a primitive of glTF: morph targets with their default weights, then the joints of a skin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "meshprep/read/gltf_buffers.h"
#include "meshprep/read/gltf_document.h"
#include "meshprep/read/gltf_nodes.h"
#include "meshprep/read/polygons.h"

namespace malus::prep {

// Of one mesh at one placement.
class GltfPose {
 public:
  // worldFromNode: of the scene. Throws Error: a joint that is not in the scene, inverse bind matrices of a wrong
  // number or type, or not finite. The references must outlive the object.
  GltfPose(const gltf::Document& document, GltfBuffers& buffers, const GltfPlacement& placement,
           const std::vector<std::optional<glm::dmat4>>& worldFromNode, const std::string& where);

  // Number of times that each vertex of a primitive is moved; 0: the primitive is the same in its pose.
  std::size_t passes(const gltf::Primitive& primitive) const;

  // Moves the vertices. kept: index in the file of each vertex of polygons. tangents: of the vertices, as
  // Polygons::tangents, or empty. Positions of skinned meshes are in world
  // space afterwards, and faces of a mirrored one are flipped. Throws Error: an attribute of a wrong number or type, a
  // joint that does not exist, values that are not finite.
  void apply(const gltf::Primitive& primitive, std::span<const std::uint32_t> kept, const std::string& location,
             Polygons& polygons, std::vector<glm::vec4>& tangents) const;

 private:
  void morph(const gltf::Primitive& primitive, std::span<const std::uint32_t> kept, Polygons& polygons,
             std::vector<glm::vec4>& tangents) const;
  void skin(const gltf::Primitive& primitive, std::span<const std::uint32_t> kept, const std::string& location,
            Polygons& polygons, std::vector<glm::vec4>& tangents) const;

  const gltf::Document& document_;
  GltfBuffers& buffers_;
  const std::string& where_;
  std::vector<double> weights_;     // of the morph targets
  std::vector<glm::dmat4> joints_;  // world from bind pose; empty: no skin
};

}  // namespace malus::prep
