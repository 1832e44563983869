// The mesh that the steps of preparation hand on: metres, in the axes of the source file.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::prep {

inline constexpr std::uint32_t kNoSource = 0xffffffffu;

struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;     // unit length, one a vertex; empty where the mesh is flat
  std::vector<glm::uvec3> triangles;  // counter-clockwise seen from outside

  // Where they come from: the vertex of the file, from 0, that each vertex is (the first of those that became it;
  // kNoSource for a new one), the face of the file that each triangle is cut from, and the vertices of the file that
  // it names (after a second round of cleaning, of those that became one, the first). Empty where nobody keeps count:
  // a mesh made in memory.
  std::vector<std::uint32_t> sourceVertices;
  std::vector<std::uint32_t> sourceFaces;
  std::vector<glm::uvec3> sourceCorners;
  std::vector<char> turned;  // 1 for triangles that lie the other way around than in the file

  // What the file says about a triangle; empty where it says nothing.
  std::vector<glm::vec3> cornerNormals;        // three a triangle, as written; zero where a corner has none
  std::vector<std::uint32_t> smoothingGroups;  // one a triangle; 0: smooth with no other
};

}  // namespace malus::prep
