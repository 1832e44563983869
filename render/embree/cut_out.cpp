#include "render/embree/cut_out.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "shaders/optics/optics.h"

namespace malus::embree {

CutOut::CutOut(const render::RenderScene& scene, std::size_t index) {
  const gpu::Mesh& mesh = scene.meshes[index];
  const gpu::MeshMaps& maps = scene.materialMaps[mesh.material];
  map_ = scene.textureMaps[maps.coverage];
  texture_ = scene.textures[map_.texture];
  cutoff_ = maps.cutoff;
  for (std::size_t i = 0; i < std::size_t{texture_.width} * texture_.height; ++i)
    texels_.push_back(scene.textureTexels[texture_.first + i].x);
  for (std::uint32_t i = 0; i < scene.meshTriangles[index]; ++i)
    for (int k = 0; k < 3; ++k) {
      const glm::vec4& t = scene.textureCoordinates[mesh.firstVertex + scene.triangles[mesh.firstTriangle + i][k]];
      const glm::vec3 p = map_.set == 1 ? glm::vec3(t.z, t.w, 1) : glm::vec3(t.x, t.y, 1);
      corners_.emplace_back(glm::dot(map_.u, p), glm::dot(map_.v, p));
    }
}

bool CutOut::isCutOut(std::uint32_t triangle, float b1, float b2) const {
  const glm::vec2* corner = corners_.data() + std::size_t{triangle} * 3;
  const glm::vec2 at = corner[0] * (1 - b1 - b2) + corner[1] * b1 + corner[2] * b2;
  const auto axis = [](float u, std::uint32_t size, gpu::uint wrap, std::size_t* texel) {
    const bool isClamped = wrap == gpu::kWrapClamp, isMirrored = wrap == gpu::kWrapMirror;
    const auto count = static_cast<float>(size);
    const float x = f32::wrapCoordinate(u, isClamped, isMirrored) * count - 0.5f, first = std::floor(x);
    for (int i = 0; i < 2; ++i)
      texel[i] = static_cast<std::size_t>(f32::wrapTexel(first + static_cast<float>(i), count, isClamped, isMirrored));
    return x - first;
  };
  std::size_t column[2], row[2];
  const float fx = axis(at.x, texture_.width, map_.wrapU, column), fy = axis(at.y, texture_.height, map_.wrapV, row);
  const auto texel = [&](int i, int j) { return texels_[row[j] * texture_.width + column[i]]; };
  const float top = texel(0, 0) * (1 - fx) + texel(1, 0) * fx, bottom = texel(0, 1) * (1 - fx) + texel(1, 1) * fx;
  return top * (1 - fy) + bottom * fy < cutoff_;
}

}  // namespace malus::embree
