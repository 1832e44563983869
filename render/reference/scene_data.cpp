#include "render/reference/scene_data.h"

#include <utility>

#include "render/scene/compiled_effects.h"
#include "render/scene/environment_distribution.h"

namespace malus::reference {

SceneData::SceneData(const pack::Scene& scene, unsigned threads)
    : SceneData(scene, render::makeRenderScene(scene), threads) {}

SceneData::SceneData(const pack::Scene& scene, render::RenderScene&& renderScene, unsigned threads)
    : scene_(scene),
      needs_(render::findGeometryNeeds(scene)),
      bvh_(renderScene, threads),
      records_{std::move(renderScene.sourceMeshes), std::move(renderScene.sourceInstances),
               std::move(renderScene.meshTransforms)},
      lightReach_(render::lightReach(scene)) {
  if (renderScene.hasMeshTextures) textures_.emplace(renderScene);
  for (const pack::Mesh& mesh : scene.meshes) faces_.push_back(computeFaces(mesh));
  computeSurfaces();
}

void SceneData::computeSurfaces() {
  areaLights_ = render::findAreaLights(scene_);
  environmentDistributions_ =
      scene_.environment.illuminates ? render::environmentDistributions(scene_.environment) : std::vector<float>();
  surfaces_.clear(), hemisphereTransmittance_.clear(), falloffs_.clear();
  for (const pack::Material& m : scene_.materials) {
    surfaces_.push_back(plainSurface(m, scene_.wavelengthsNm));
    hemisphereTransmittance_.push_back(render::hemisphereTransmittance(m, scene_.wavelengthsNm));
  }
  for (const pack::LightSource& light : scene_.lights) falloffs_.push_back(pack::spotFalloff(light));
}

bool SceneData::update() {
  if (render::findGeometryNeeds(scene_) != needs_) return false;
  computeSurfaces();
  return true;
}

SceneAccess SceneData::access(const render::RenderParameters& parameters) const {
  return {scene_,
          bvh_,
          records_,
          faces_,
          surfaces_,
          hemisphereTransmittance_,
          falloffs_,
          lightReach_,
          textures_ ? &*textures_ : nullptr,
          render::cameraCone(scene_.camera, parameters),
          areaLights_,
          environmentDistributions_,
          parameters.lightSamples,
          render::filtersShadows(scene_, parameters)};
}

}  // namespace malus::reference
