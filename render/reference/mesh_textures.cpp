#include "render/reference/mesh_textures.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "render/scene/scene_textures.h"

namespace malus::reference {

using glm::dvec2;
using glm::dvec3;

namespace {

dvec2 mapCoordinates(const pack::MeshMap& map, const f64::TexturePoint& p) {
  const dvec3 at = map.set == 1 ? dvec3(p.u1, p.v1, 1) : dvec3(p.u0, p.v0, 1);
  return {glm::dot(map.u, at), glm::dot(map.v, at)};
}

// The two texels of an axis, and the share of the second.
struct Pair {
  std::size_t first, second;
  double share;
};
Pair findPair(double u, std::uint32_t size, pack::Wrap wrap) {
  const bool isClamped = wrap == pack::Wrap::clamp, isMirrored = wrap == pack::Wrap::mirror;
  const double x = f64::wrapCoordinate(u, isClamped, isMirrored) * size - 0.5, first = std::floor(x);
  const auto texel = [&](double i) { return static_cast<std::size_t>(f64::wrapTexel(i, size, isClamped, isMirrored)); };
  return {texel(first), texel(first + 1), x - first};
}

}  // namespace

MeshTextures::MeshTextures(render::RenderScene& scene)
    : textures_(std::move(scene.textures)),
      textureRows_(std::move(scene.textureRows)),
      texels_(std::move(scene.textureTexels)) {}

dvec3 MeshTextures::level(std::size_t row, const pack::MeshMap& map, const dvec2& uv) const {
  const gpu::Texture& t = textures_[row];
  const Pair x = findPair(uv.x, t.width, map.wrapU), y = findPair(uv.y, t.height, map.wrapV);
  const auto texel = [&](std::size_t column, std::size_t line) {
    return dvec3(texels_[t.first + line * t.width + column]);
  };
  return (texel(x.first, y.first) * (1 - x.share) + texel(x.second, y.first) * x.share) * (1 - y.share) +
         (texel(x.first, y.second) * (1 - x.share) + texel(x.second, y.second) * x.share) * y.share;
}

dvec3 MeshTextures::finest(const pack::MeshMap& map, const f64::TexturePoint& point) const {
  return level(textureRows_[static_cast<std::size_t>(map.texture)], map, mapCoordinates(map, point));
}

dvec3 MeshTextures::at(const pack::MeshMap& map, const f64::TextureHit& hit) const {
  const std::size_t row = textureRows_[static_cast<std::size_t>(map.texture)];
  const dvec2 uv = mapCoordinates(map, hit.at);
  const double width = textures_[row].width, height = textures_[row].height,
               scale = std::abs(map.u.x * map.v.y - map.u.y * map.v.x) * width * height,
               texels = (map.set == 1 ? hit.footprint1 : hit.footprint0) * std::sqrt(scale),
               lod = f64::textureLevel(texels, render::countLevels(textures_[row].width, textures_[row].height)),
               fine = std::floor(lod), share = lod - fine;
  const std::size_t first = row + static_cast<std::size_t>(fine);
  if (share == 0) return level(first, map, uv);
  return level(first, map, uv) * (1 - share) + level(first + 1, map, uv) * share;
}

}  // namespace malus::reference
