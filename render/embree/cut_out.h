// Parts of a mesh that an image cuts out, for the filter functions of Embree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "render/scene/render_scene.h"

namespace malus::embree {

class CutOut {
 public:
  // mesh: one whose material has a coverage map.
  CutOut(const render::RenderScene& scene, std::size_t mesh);

  // Whether a triangle is cut out at the barycentric coordinates (b1, b2): the coverage, bilinear in level 0 of the
  // texture, is below the cutoff.
  bool isCutOut(std::uint32_t triangle, float b1, float b2) const;

 private:
  std::vector<glm::vec2> corners_;  // texture coordinates, three per triangle
  std::vector<float> texels_;
  gpu::Texture texture_;
  gpu::TextureMap map_;
  float cutoff_;
};

}  // namespace malus::embree
