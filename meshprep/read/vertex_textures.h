// Texture coordinates and tangents of vertices, as glTF has them; polygons have them per corner.
#pragma once

#include <array>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "meshprep/read/polygons.h"

namespace malus::prep {

// One per vertex, or empty.
struct VertexTextures {
  std::array<std::vector<glm::vec2>, 2> coordinates;
  std::vector<glm::vec4> tangents;  // as Polygons::tangents

  // Sets those of the corners of polygons with the same vertices.
  void setCorners(Polygons& polygons) const {
    const auto set = [&](const auto& values, auto& corners) {
      corners.clear();
      if (values.empty()) return;
      corners.reserve(polygons.corners.size());
      for (const std::uint32_t vertex : polygons.corners) corners.push_back(values[vertex]);
    };
    for (std::size_t i = 0; i < coordinates.size(); ++i) set(coordinates[i], polygons.textureCoordinates[i]);
    set(tangents, polygons.tangents);
  }
};

}  // namespace malus::prep
