// The faces of a file as they are written: positions, and for every face the corners that it names. No
// connectivity is derived, so faces that no half-edge structure can hold stay as they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::prep {

struct Polygons {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;              // one a position, as written, where the file has them (PLY)
  std::vector<std::uint32_t> corners;          // indices into positions, face after face
  std::vector<std::size_t> firstCorner = {0};  // of every face, and one past the last

  std::size_t faceCount() const { return firstCorner.size() - 1; }
  std::span<const std::uint32_t> face(std::size_t i) const {
    return std::span(corners).subspan(firstCorner[i], firstCorner[i + 1] - firstCorner[i]);
  }
  // Makes a face of the corners added since the last one.
  void closeFace() { firstCorner.push_back(corners.size()); }
};

}  // namespace malus::prep
