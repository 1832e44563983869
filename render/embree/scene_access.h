// Base of every tracer: the scene, its tables and counters, as shaders/surfaces/hooks.h names them. The shared
// surfaces are members of the tracers and find these by name.
#pragma once

#include "render/embree/tile.h"
#include "render/embree/tile_effects.h"
#include "shaders/methods/methods.h"

namespace malus::embree {

struct SceneAccess {
  explicit SceneAccess(const TileInput& tile)
      : bvh(*tile.bvh),
        scene(*tile.scene),
        camera(*tile.camera),
        materials(scene.materials.data()),
        lights(scene.lights.data()),
        lightShapes(scene.lightShapes.data()),
        extras(scene.extras.data()),
        textures(scene.textures.data()),
        textureTexels(scene.textureTexels.data()),
        environmentTexels(scene.environmentTexels.data()),
        materialMaps(scene.materialMaps.data()),
        textureMaps(scene.textureMaps.data()),
        log(tile.log) {}

  const Bvh& bvh;
  const render::RenderScene& scene;
  const gpu::CameraParameters& camera;
  const gpu::Material* materials;
  const gpu::PointLight* lights;
  const gpu::LightShape* lightShapes;
  const gpu::MaterialExtra* extras;
  const gpu::Texture* textures;
  const glm::vec3* textureTexels;
  const glm::vec3* environmentTexels;
  const gpu::MeshMaps* materialMaps;
  const gpu::TextureMap* textureMaps;
  RayLog* log;     // of the tracers that check numerics; null: none
  int bounce = 0;  // of the ray that was traced last, if there is a log
  std::uint64_t rays = 0;
  std::uint32_t pixelX = 0, pixelY = 0;  // the pixel that is rendered, in the whole image
  render::Faults faults;

  const gpu::MaterialExtra& materialExtra(gpu::uint material) const { return extras[material]; }

  const gpu::LightShape& lightShape(int index) const { return lightShapes[index]; }

  const gpu::AreaLight& areaLight(gpu::uint index) const { return scene.areaLights[index]; }
  const gpu::LightNode& lightNode(gpu::uint index) const { return scene.lightNodes[index]; }
  float environmentDistribution(float index) const {
    return scene.environmentDistributions[static_cast<std::size_t>(index)];
  }

  glm::vec3 environmentTexel(float x, float y) const {
    return environmentTexels[static_cast<int>(y) * (camera.environmentSize + 2) + static_cast<int>(x)];
  }

  glm::vec3 texel(gpu::uint index, float x, float y) const {
    const gpu::Texture& t = textures[index];
    const int width = static_cast<int>(t.width), height = static_cast<int>(t.height);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const auto repeated = [](int i, int size) { return i < 0 ? i + size : i >= size ? i - size : i; };
    return textureTexels[static_cast<int>(t.first) + repeated(row, height) * width + repeated(column, width)];
  }

  bool hasMeshTextures() const { return scene.hasMeshTextures; }
  const gpu::MeshMaps& meshMaps(gpu::uint material) const { return materialMaps[material]; }
  const gpu::TextureMap& textureMap(gpu::uint map) const { return textureMaps[map]; }
  gpu::uint textureRow(gpu::uint index, float level) const { return index + static_cast<gpu::uint>(level); }

  void textureSize(gpu::uint index, float& width, float& height) const {
    width = static_cast<float>(textures[index].width);
    height = static_cast<float>(textures[index].height);
  }
};

// Renders every pixel of a tile. pixel(tracer, out) renders the tracer's pixel into `channels` floats.
template <class Tracer, class Pixel>
TileOutput renderPixels(const TileInput& tile, std::size_t channels, Pixel pixel) {
  Tracer tracer(tile);
  const gpu::CameraParameters& camera = *tile.camera;
  for (std::uint32_t y = tile.beginY; y < tile.endY; ++y)
    for (std::uint32_t x = tile.beginX; x < tile.endX; ++x) {
      tracer.pixelX = x + camera.regionX;
      tracer.pixelY = y + camera.regionY;
      pixel(tracer, tile.pixels + (std::size_t{y} * camera.regionWidth + x) * channels);
    }
  return {tracer.rays, tracer.faults};
}

}  // namespace malus::embree
