// Open edges that pieces of a surface share. An edge of a piece is open if the piece has one face there.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/mesh.h"
#include "meshprep/prepare.h"
#include "meshprep/read/polygons.h"

namespace malus::bake {

// Two pieces that share open edges: the number, and the ends of the first one.
struct Neighbours {
  std::size_t a = 0, b = 0;  // indices of pieces, a < b
  std::size_t edges = 0;
  glm::dvec3 low{0}, high{0};
};

struct OpenEdges {
  std::vector<Neighbours> neighbours;
  std::vector<std::size_t> counts;  // of open edges, per piece

  // The pieces as one welded mesh, in which a face of n corners is a fan of triangles. Triangles that are lines or
  // points are missing.
  prep::Mesh mesh;
  std::vector<std::size_t> pieceOf;  // per triangle
  std::vector<glm::uvec3> corners;   // per triangle: vertices of the piece
  std::vector<char> isShared;        // per vertex of the mesh: 1 at the ends of shared open edges
};

// Welds with the tolerance of `preparation`, or with relativeTolerance of the largest coordinate if that is larger.
OpenEdges findOpenEdges(std::span<const prep::Polygons* const> pieces, const prep::Options& preparation,
                        double relativeTolerance = 0);

}  // namespace malus::bake
