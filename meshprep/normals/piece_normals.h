// One normal for each smooth piece of surface around a vertex: what crease angles and smoothing groups have in common.
//
// Two triangles at a vertex belong together where they share an edge there, no third triangle does, both have
// the same side outward and the edge is smooth; pieces are what hangs together by that. A piece's normal is the mean
// of its triangles' normals, weighted by their angles at the vertex, which does not depend on how a face was cut into
// triangles.
// Source: G. Thurmer, C. A. Wuethrich, "Computing vertex normals from polygonal facets", Journal of Graphics
// Tools 3(1), 1998.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "meshprep/mesh.h"

namespace malus::prep {

struct NormalCounts {
  std::uint64_t added = 0;      // vertices that the pieces made necessary
  std::uint64_t undefined = 0;  // pieces whose normals cancel: they got their first triangle's
};

// Whether the edge between two triangles, of these unit normals, is smooth.
using IsSmooth =
    std::function<bool(std::uint32_t a, std::uint32_t b, const glm::dvec3& normalA, const glm::dvec3& normalB)>;

// Stores one vertex a piece: vertices in their order, a vertex's pieces by their first triangles. Triangles
// keep their order. A vertex of no triangle stays, with any normal.
NormalCounts addPieceNormals(Mesh& mesh, const IsSmooth& isSmooth);

// Unit; zero for a triangle without area.
glm::dvec3 faceNormal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace malus::prep
