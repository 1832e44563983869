// Faces of a file: positions, the corners of every face, and their attributes. There is no connectivity, so
// non-manifold faces are possible.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "meshprep/compress/texture_rounding.h"

namespace malus::prep {

// Group of faces: a group or object of OBJ, a primitive of glTF.
struct Part {
  std::string name;      // empty if the file has none
  std::string material;  // name in the file; empty if it has none
  friend bool operator==(const Part&, const Part&) = default;
};

// Begins a note about content that is read although the format does not permit it; other notes are about content that
// is ignored.
inline constexpr std::string_view kAcceptedNote = "accepted: ";

using compress::kMaxTextureCoordinate;

// Returns true if a texture coordinate is a finite number in the accepted range.
inline bool isAcceptedCoordinate(double value) {
  return value >= -kMaxTextureCoordinate && value <= kMaxTextureCoordinate;
}

// Notes about texture coordinates and tangents that are left out, and about those that change nothing.
inline constexpr std::string_view kTextureCoordinatesNote = "texture coordinates";
inline constexpr std::string_view kTangentsNote = "tangents";
inline constexpr std::string_view kUnusedCoordinatesNote = "texture coordinates that no texture uses";
inline constexpr std::string_view kUnusedTangentsNote = "tangents that no normal map uses";
// Note about corners that lack them beside others.
inline constexpr std::string_view kMissingCoordinatesNote =
    "accepted: corners without texture coordinates, which get (0, 0)";

struct Polygons {
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> corners;          // indices into positions, face by face; a face may have fewer than 3
  std::vector<std::size_t> firstCorner = {0};  // index into corners of each face, and the number of corners

  // Attributes as in the file; empty if the file has none.
  std::vector<glm::vec3> normals;        // one per position (PLY, OFF, glTF); any length
  std::vector<glm::vec3> cornerNormals;  // one per corner (OBJ); zero for a corner without
  // Sets 0 and 1 of texture coordinates, one per corner (OBJ, glTF): in repeats of the image, from its upper left
  // corner, v down as in glTF. (0, 0) for a corner without.
  std::array<std::vector<glm::vec2>, 2> textureCoordinates;
  // One per corner (glTF): xyz in the direction of growing u, any length, zero for a corner without; w = 1 or -1 is the
  // sign of the bitangent w cross(normal, tangent).
  std::vector<glm::vec4> tangents;
  std::vector<std::uint32_t> smoothingGroups;  // one per face (OBJ); 0: no smoothing
  std::vector<std::uint32_t> partOf;           // index into parts, one per face
  std::vector<Part> parts;                     // empty: all faces are one unnamed part
  std::vector<std::string>
      materialFiles;  // argument of each mtllib statement: one name, or several separated by blanks

  // Location of each vertex and face in the file: line, from 1, or byte, from 0. Empty if unknown.
  bool locationsAreBytes = false;
  std::vector<std::uint64_t> vertexLocations;
  std::vector<std::uint64_t> faceLocations;

  // Ignored content, each kind once: "colours of vertices"; and after kAcceptedNote, what does not conform to the
  // format but is read.
  std::vector<std::string> notes;

  bool hasTextureAttributes() const {
    return !textureCoordinates[0].empty() || !textureCoordinates[1].empty() || !tangents.empty();
  }
  void dropTextureAttributes() {
    textureCoordinates = {};
    tangents = {};
  }

  std::size_t faceCount() const { return firstCorner.size() - 1; }
  std::span<const std::uint32_t> face(std::size_t i) const {
    return std::span(corners).subspan(firstCorner[i], firstCorner[i + 1] - firstCorner[i]);
  }
  // Makes a face of the corners added since the last call.
  void closeFace() { firstCorner.push_back(corners.size()); }
};

}  // namespace malus::prep
