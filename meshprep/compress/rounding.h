// Rounding of the meshes of a scene to their grids, with the choice of steps and numbers of bits.
//
// Each mesh has its own step, a power of two; all grids have their anchor at the origin of the coordinates. Meshes that
// share positions are a group: a shared position is rounded to the coarsest step of its meshes, so that it stays equal
// in all of them and no crack appears. Steps are refined until every mesh is within its bounds: distance of a vertex
// from its source, tilt of a face; no face may lose its area or flip; and until the caller accepts the result.
//
// For the renderers, the positions of a group relative to the group's origin are floats. The origin is 0 if floats
// relative to 0 are fine enough and no mesh of the group is placed by transforms.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/compress/bounds.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// First numbers of bits to try: of positions over the whole scene, of positions over each mesh, of normals. If a bound
// is given, all numbers are tried.
inline constexpr int kFirstPositionBits = 20;
inline constexpr int kFirstMeshBits = 16;
inline constexpr int kFirstNormalBits = 12;

enum class Precision {
  doubles,  // any point of the grid
  floats,   // position minus RoundedMesh::origin is a float
};

struct RoundedMesh {
  Grid grid;                          // encloses the positions
  glm::dvec3 origin{0};               // multiple of the step, itself a float; 0 with Precision::doubles
  std::vector<glm::dvec3> positions;  // points of the grid, one per vertex
  int normalBits = 0;
};

// Inspection of rounded meshes by the caller. No member: they are accepted.
struct Inspection {
  // Returns the meshes that need a finer grid; none: the meshes are accepted.
  std::function<std::vector<std::size_t>(std::span<const RoundedMesh>)> find;
  // Called if the finest grids are not accepted. May throw Error.
  std::function<void(std::span<const RoundedMesh>)> refuse;
};

// Returns one rounded mesh per mesh. If no grid is fine enough for the bounds, the finest ones are returned;
// the caller measures the result. Throws Error: bits or bounds out of range, a position that is not
// finite, a mesh or a scene outside of the accepted range of sizes.
std::vector<RoundedMesh> roundMeshes(std::span<const MeshView> meshes, const Bounds& bounds, Precision precision,
                                     const Inspection& inspect = {});

}  // namespace malus::compress
