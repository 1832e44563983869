// The faces of a file as they are written: positions, and for every face the corners that it names, with what the
// file says about them besides. No connectivity is derived, so faces that no half-edge structure can hold stay as
// they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::prep {

// Faces that a file keeps together: a group or object of OBJ, a primitive of glTF.
struct Part {
  std::string name;      // empty where the file gives none
  std::string material;  // as the file names it; empty where it names none
  friend bool operator==(const Part&, const Part&) = default;
};

struct Polygons {
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> corners;          // indices into positions, face after face
  std::vector<std::size_t> firstCorner = {0};  // of every face, and one past the last

  // What a file may say besides, as it is written; empty where it says nothing.
  std::vector<glm::vec3> normals;              // one a position (PLY, glTF)
  std::vector<glm::vec3> cornerNormals;        // one a corner (OBJ); zero where a corner has none
  std::vector<std::uint32_t> smoothingGroups;  // one a face (OBJ); 0: smooth with no other
  std::vector<std::uint32_t> partOf;           // one a face: index into parts
  std::vector<Part> parts;                     // empty: all faces are one part without a name
  std::vector<std::string> materialFiles;      // of each mtllib statement: one name, or several with blanks between

  // Where each vertex and face is written: a line, from 1, or a byte, from 0. Both empty where that is not told.
  bool locationsAreBytes = false;
  std::vector<std::uint64_t> vertexLocations;
  std::vector<std::uint64_t> faceLocations;

  // What the file holds and nobody here has a use for, once each: "colours of vertices".
  std::vector<std::string> notes;

  std::size_t faceCount() const { return firstCorner.size() - 1; }
  std::span<const std::uint32_t> face(std::size_t i) const {
    return std::span(corners).subspan(firstCorner[i], firstCorner[i + 1] - firstCorner[i]);
  }
  // Makes a face of the corners added since the last one.
  void closeFace() { firstCorner.push_back(corners.size()); }
};

}  // namespace malus::prep
