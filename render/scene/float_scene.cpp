#include "render/scene/float_scene.h"

#include <cmath>
#include <numbers>

#include "shaders/optics/optics.h"

namespace malus::render {

gpu::SurfaceKind surfaceKind(pack::MaterialKind kind) {
  switch (kind) {
    case pack::MaterialKind::lambert:
      return gpu::kLambert;
    case pack::MaterialKind::paint:
      return gpu::kPaint;
    case pack::MaterialKind::mirrorGlass:
      return gpu::kPaint;  // paint without albedo
    case pack::MaterialKind::metal:
      return gpu::kMetal;
    case pack::MaterialKind::glass:
      return gpu::kGlass;
    case pack::MaterialKind::emitter:
      return gpu::kEmitter;
  }
  return gpu::kLambert;
}

glm::dvec3 hemisphereTransmittance(const pack::Material& m) {
  if (m.kind == pack::MaterialKind::lambert || m.kind == pack::MaterialKind::emitter) return glm::dvec3(1.0);
  constexpr int kSteps = 256;
  glm::dvec3 sum(0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double c = (i + 0.5) / kSteps;
    for (int colour = 0; colour < 3; ++colour) {
      const f64::Reflectance r = m.kind == pack::MaterialKind::metal
                                     ? f64::conductorReflectance(c, m.outsideEta, m.eta[colour], m.k[colour])
                                     : f64::dielectricReflectance(c, m.outsideEta, m.eta.y);
      sum[colour] += 2 * c * (1 - 0.5 * (r.rs + r.rp)) / kSteps;
    }
  }
  return sum;
}

FloatScene floatScene(const pack::Scene& scene) {
  FloatScene result;
  for (const pack::Material& m : scene.materials) {
    gpu::Material g{};
    const double basic = 1 / (m.outsideEta * m.outsideEta);
    g.eta = glm::vec3(m.eta);
    g.k = glm::vec3(m.k);
    g.albedo = glm::vec3(m.albedo);
    g.radiance = glm::vec3(m.radiance * basic);
    g.fillTransmittance = glm::vec3(hemisphereTransmittance(m));
    g.outsideEta = static_cast<float>(m.outsideEta);
    g.basicScale = static_cast<float>(basic);
    g.highlightStrength = static_cast<float>(m.highlightStrength);
    g.highlightExponent = static_cast<int>(m.highlightExponent);
    g.kind = surfaceKind(m.kind);
    result.materials.push_back(g);
  }
  for (const pack::PointLight& light : scene.lights)
    result.lights.push_back({glm::vec3(light.position), glm::vec3(light.intensity)});
  for (const pack::Mesh& mesh : scene.meshes) {
    result.meshes.push_back({static_cast<std::uint32_t>(result.triangles.size()),
                             static_cast<std::uint32_t>(result.positions.size()), mesh.material,
                             mesh.normals.empty() ? 0u : 1u});
    result.meshTriangles.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    result.meshVertices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    result.positions.insert(result.positions.end(), mesh.positions.begin(), mesh.positions.end());
    result.normals.insert(result.normals.end(), mesh.normals.begin(), mesh.normals.end());
    result.normals.resize(result.positions.size(), glm::vec3(0));
    result.triangles.insert(result.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  }
  result.environmentTexels = scene.environment.texels;
  if (result.environmentTexels.empty()) result.environmentTexels.emplace_back(0.0f);
  return result;
}

gpu::Frame frameOf(const pack::Scene& scene, const View& view) {
  gpu::Frame f{};
  const pack::Camera& camera = scene.camera;
  const double tanY = std::tan(camera.verticalFovDegrees / 360 * std::numbers::pi);
  f.eye = glm::vec3(camera.position);
  f.right = glm::vec3(camera.right);
  f.up = glm::vec3(camera.up);
  f.forward = glm::vec3(camera.forward);
  f.tanX = static_cast<float>(tanY * view.width / view.height);
  f.tanY = static_cast<float>(tanY);
  f.basicToRadiance = static_cast<float>(camera.mediumEta * camera.mediumEta);
  for (int i = 0; i < 4; ++i) f.analyser[i] = static_cast<float>(view.analyser[static_cast<std::size_t>(i)]);
  f.width = view.width;
  f.height = view.height;
  f.regionX = view.region.x;
  f.regionY = view.region.y;
  f.regionWidth = view.region.width;
  f.regionHeight = view.region.height;
  f.samples = view.samples;
  f.depth = static_cast<int>(view.depth);
  f.lightCount = static_cast<int>(scene.lights.size());
  f.environmentSize = static_cast<int>(scene.environment.size);
  f.environment = glm::vec3(scene.environment.radiance);
  f.fill = static_cast<float>(scene.environment.diffuseFill);
  f.shadows = view.shadows ? 1 : 0;
  for (int i = 0; i < 9; ++i) f.irradiance[i] = glm::vec3(scene.environment.irradiance[static_cast<std::size_t>(i)]);
  return f;
}

}  // namespace malus::render
