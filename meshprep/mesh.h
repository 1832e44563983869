// The mesh that the steps of preparation hand on: metres, in the axes of the source file.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace malus::prep {

struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;     // unit length, one a vertex; empty where the mesh is flat
  std::vector<glm::uvec3> triangles;  // counter-clockwise seen from outside
};

}  // namespace malus::prep
