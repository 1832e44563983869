// The rounding that Draco's quantizers do, in their own arithmetic: what a mesh will decode to, without encoding it.
// For choosing bits only; what was chosen is measured on decoded bytes.
//
// Source: Draco 1.5.5, attribute_quantization_transform.cc, quantization_utils.h, normal_compression_utils.h.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Positions within the grid, each at its nearest point as floats give it.
std::vector<glm::vec3> roundedPositions(std::span<const glm::vec3> positions, const Grid& grid);

// Unit normals through octahedral coordinates of `bits` bits (2 to 16), unit again.
std::vector<glm::vec3> roundedNormals(std::span<const glm::vec3> normals, int bits);

}  // namespace malus::compress
