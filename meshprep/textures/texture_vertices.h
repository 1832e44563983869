// Texture coordinates and tangents of vertices, by splitting those whose corners differ.
//
// Cleaning, certificates and normals see the welded surface, in which the two sides of a seam share their vertices.
// Afterwards each vertex becomes one vertex per different set of attributes of its corners.
#pragma once

#include <cstdint>

#include "meshprep/mesh.h"

namespace malus::prep {

struct TextureVertexCounts {
  std::uint64_t added = 0;     // vertices that seams made necessary
  std::uint64_t filled = 0;    // corners that cleaning added, with the attributes of another corner of their vertex
  std::uint64_t tangents = 0;  // corners whose tangent has no direction, with that of the coordinates
};

// Sets textureCoordinates and tangents from cornerTextures, which must not be empty, and removes these. Vertices keep
// their order, those of one vertex by their first corners; one of no triangle stays, with zeros. Triangles keep their
// order. Tangents become unit vectors; one without a direction gets that in which u of set 0 (or else 1) grows on its
// triangle, or else any direction in the triangle. Their signs keep the side of the bitangent where cleaning flipped a
// triangle or a normal of the file.
TextureVertexCounts addTextureVertices(Mesh& mesh);

}  // namespace malus::prep
