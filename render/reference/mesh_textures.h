// Textures by the texture coordinates of meshes, in double precision; the levels of their pyramids are those of the
// other renderers.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/pack/scene.h"
#include "render/scene/render_scene.h"
#include "shaders/optics/optics.h"

namespace malus::reference {

class MeshTextures {
 public:
  // Takes the textures of the scene.
  explicit MeshTextures(render::RenderScene& scene);

  // The value of a map that is used, between the two levels that are nearest to the footprint.
  glm::dvec3 at(const pack::MeshMap& map, const f64::TextureHit& hit) const;
  // The same at level 0.
  glm::dvec3 finest(const pack::MeshMap& map, const f64::TexturePoint& point) const;

 private:
  glm::dvec3 level(std::size_t row, const pack::MeshMap& map, const glm::dvec2& uv) const;

  std::vector<gpu::Texture> textures_;      // with the levels
  std::vector<std::uint32_t> textureRows_;  // first level of each texture of the pack
  std::vector<glm::vec3> texels_;
};

}  // namespace malus::reference
