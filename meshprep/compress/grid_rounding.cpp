#include "meshprep/compress/grid_rounding.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <draco/compression/attributes/normal_compression_utils.h>
#include <draco/core/quantization_utils.h>
#include <glm/geometric.hpp>

namespace malus::compress {

std::vector<glm::vec3> roundPositions(std::span<const glm::vec3> positions, const Grid& grid) {
  const auto steps = static_cast<std::int32_t>((1u << static_cast<unsigned>(grid.positionBits)) - 1u);
  draco::Quantizer quantizer;
  draco::Dequantizer dequantizer;
  quantizer.Init(grid.range, steps);
  dequantizer.Init(grid.range, steps);
  std::vector<glm::vec3> rounded(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const float local = positions[i][axis] - grid.origin[axis];
      rounded[i][axis] = dequantizer.DequantizeFloat(quantizer.QuantizeFloat(local)) + grid.origin[axis];
    }
  return rounded;
}

std::vector<glm::vec3> roundNormals(std::span<const glm::vec3> normals, int bits) {
  draco::OctahedronToolBox octahedron;
  octahedron.SetQuantizationBits(bits);
  std::vector<glm::vec3> rounded(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const std::array<float, 3> normal{normals[i].x, normals[i].y, normals[i].z};
    std::array<float, 3> decoded{};
    std::int32_t s = 0, t = 0;
    octahedron.FloatVectorToQuantizedOctahedralCoords(normal.data(), &s, &t);
    octahedron.QuantizedOctahedralCoordsToUnitVector(s, t, decoded.data());
    const glm::vec3 unit(decoded[0], decoded[1], decoded[2]);
    rounded[i] = unit / glm::length(unit);  // normalize as decode() does
  }
  return rounded;
}

}  // namespace malus::compress
