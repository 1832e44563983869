// Simplification of meshes with texture coordinates or tangents.
//
// The mesh is cut along the edges at which they differ. The two sides of a cut are boundaries, which simplification
// does not move, and each vertex has one set of attributes. Afterwards the sides are joined again. So seams keep their
// places, and a triangle that gets a corner gets its attributes on the same side of the seam. If a distance is given as
// the bound of the surface (--simplify-error), the image on the surface moves by no more than that.
#pragma once

#include <cstdint>
#include <vector>

#include "meshprep/mesh.h"

namespace malus::prep {

class Seams {
 public:
  // Cuts the mesh, which must have cornerTextures, and removes these.
  explicit Seams(Mesh& mesh);

  // Joins the sides and sets the cornerTextures. The vertices of the mesh are some of those after the constructor, in
  // their order, and sourceVertices are as it left them.
  void join(Mesh& mesh) const;

  // Largest distance, metres, by which simplification moves the image on the surface: for each vertex of `before`, the
  // error of the coordinates that `after` has there, times the square root of the ratio of the areas of the triangle on
  // the surface and in the image; the smallest of the triangles within `reach`. Both meshes are cut; before: as the
  // constructor left it.
  double imageDeviation(const Mesh& before, const Mesh& after, double reach) const;

 private:
  double imageDistance(const Mesh& mesh, std::uint32_t triangle, const glm::dvec3& p,
                       const CornerTexture& texture) const;

  std::vector<std::uint32_t> before_;          // vertex before the cut, of each vertex
  std::vector<std::uint32_t> sourceVertices_;  // of the vertices before the cut
  std::vector<CornerTexture> textures_;        // of each vertex
};

}  // namespace malus::prep
