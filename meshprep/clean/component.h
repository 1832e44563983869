// Connected component of a mesh: triangles connected through edges that exactly two triangles share.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace malus::prep {

struct Component {
  std::uint64_t triangles = 0;
  bool closed = false;           // has no boundary edge
  bool orientable = true;        // has two distinct sides; false for a Moebius strip
  std::uint64_t flipped = 0;     // triangles whose orientation differs from the file's
  double signedVolume = 0;       // cubic metres after orientation; 0 unless closed and orientable
  bool hasVolume = false;        // closed, orientable, and its volume is above rounding error; false for open surfaces
  bool isNestedOutward = false;  // inside another component, and both face outward, or both inward
  glm::dvec3 at{0};              // a corner of its first triangle, metres
  std::uint32_t firstFace = 0;   // its first face in the source file, from 0
};

}  // namespace malus::prep
