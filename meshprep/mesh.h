// Triangle mesh of the steps of preparation, in metres and the axes of the source file.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace malus::prep {

inline constexpr std::uint32_t kNoSource = 0xffffffffu;

// Texture coordinates, by set, and tangent of a corner of a triangle, as in Polygons.
struct CornerTexture {
  std::array<glm::vec2, 2> coordinates{};
  glm::vec4 tangent{0, 0, 0, 1};
  bool isMissing = false;  // of a corner that cleaning added
};

// Part of a mesh that was prepared in pieces (instances.h): vertices and triangles from the first ones to those of the
// next piece.
struct MeshPiece {
  std::uint32_t firstVertex = 0, firstTriangle = 0;

  // Placed = linear * p + translation maps the vertices of the piece `original`, in order, to those of this one, apart
  // from rounding errors of double: a similarity with this scale. The corners of triangles may be mirrored.
  std::uint32_t original = 0;  // itself, or an earlier piece
  glm::dmat3 linear{1.0};
  glm::dvec3 translation{0};
  double scale = 1;
};

struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;     // unit length, one per vertex; empty if the mesh is flat
  std::vector<glm::uvec3> triangles;  // counter-clockwise seen from outside

  // As in pack::Mesh: one per vertex, or empty (textures/texture_vertices.h).
  std::array<std::vector<glm::vec2>, 2> textureCoordinates;
  std::vector<glm::vec4> tangents;

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
  std::vector<CornerTexture> cornerTextures;   // three per triangle
  std::array<bool, 2> hasCoordinates{};        // sets of texture coordinates that cornerTextures has
  bool hasTangents = false;

  std::vector<MeshPiece> pieces;  // whose boxes do not touch; empty for one piece
};

}  // namespace malus::prep
