// A scene with the tables that the rays of the reference read.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bake/pack/scene.h"
#include "render/embree/embree.h"
#include "render/reference/hit.h"
#include "render/reference/mesh_textures.h"
#include "render/scene/render_parameters.h"
#include "render/scene/render_scene.h"

namespace malus::reference {

class SceneData {
 public:
  // Builds the acceleration structure. scene must outlive the data. threads: 0 for all cores. Throws Error if Embree
  // fails.
  SceneData(const pack::Scene& scene, unsigned threads);
  SceneData(pack::Scene&& scene, unsigned threads) = delete;

  // As Renderer::updateScene() of render/renderer.h.
  bool update();

  const pack::Scene& scene() const { return scene_; }
  // Valid as long as the data and until the next update().
  SceneAccess access(const render::RenderParameters& parameters) const;

 private:
  SceneData(const pack::Scene& scene, render::RenderScene&& renderScene, unsigned threads);
  void computeSurfaces();

  const pack::Scene& scene_;
  render::GeometryNeeds needs_;
  embree::Bvh bvh_;
  MeshRecords records_;
  std::vector<std::vector<Face>> faces_;  // per triangle of each mesh
  std::optional<MeshTextures> textures_;
  double lightReach_ = 0;
  render::AreaLights areaLights_;
  std::vector<float> environmentDistributions_;
  std::vector<Surface> surfaces_;               // per material
  std::vector<dvec3> hemisphereTransmittance_;  // the same
  std::vector<pack::SpotFalloff> falloffs_;     // per light
};

}  // namespace malus::reference
