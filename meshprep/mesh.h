// Triangle mesh of the steps of preparation, in metres and the axes of the source file.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::prep {

inline constexpr std::uint32_t kNoSource = 0xffffffffu;

struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;     // unit length, one per vertex; empty if the mesh is flat
  std::vector<glm::uvec3> triangles;  // counter-clockwise seen from outside

  // Sources in the file, from 0: the vertex of each vertex (the first of joined ones; kNoSource for a new one), the
  // face of each triangle, and the vertices of each triangle's corners (after a second pass of cleaning, the first of
  // joined ones). Empty for a mesh without a file.
  std::vector<std::uint32_t> sourceVertices;
  std::vector<std::uint32_t> sourceFaces;
  std::vector<glm::uvec3> sourceCorners;
  std::vector<char> flipped;  // 1 for triangles with the opposite orientation of the file

  // Attributes of triangles in the file; empty if it has none.
  std::vector<glm::vec3> cornerNormals;        // three per triangle, any length; zero for a corner without
  std::vector<std::uint32_t> smoothingGroups;  // one per triangle; 0: no smoothing
};

}  // namespace malus::prep
