// Prediction of decoded values: the arithmetic of Draco's quantizers without encoding. Used to choose the numbers of
// bits (bounds.h); the chosen encoding is measured on decoded bytes.
//
// Source: Draco 1.5.5, attribute_quantization_transform.cc, quantization_utils.h, normal_compression_utils.h.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Rounds positions to the grid. They must be inside it. The result has the rounding errors of Draco's float arithmetic.
std::vector<glm::vec3> roundPositions(std::span<const glm::vec3> positions, const Grid& grid);

// Rounds unit normals to octahedral coordinates with `bits` bits (kMinNormalBits to kMaxNormalBits), and normalizes.
std::vector<glm::vec3> roundNormals(std::span<const glm::vec3> normals, int bits);

}  // namespace malus::compress
