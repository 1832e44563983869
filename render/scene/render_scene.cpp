#include "render/scene/render_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "bake/effects/effects.h"
#include "bake/pack/instances.h"
#include "bake/pack/mesh_maps.h"
#include "render/scene/area_lights.h"
#include "render/scene/compiled_effects.h"
#include "render/scene/environment_distribution.h"
#include "render/scene/image_plane.h"
#include "render/scene/mesh_transform.h"
#include "render/scene/scene_textures.h"
#include "shaders/optics/optics.h"

namespace malus::render {

// Kinds of surface are the first effects (shaders/effects.def).
gpu::SurfaceKind surfaceKind(pack::MaterialKind kind) {
  return static_cast<gpu::SurfaceKind>(bake::surfaceEffect(kind));
}

glm::dvec3 roundTripPhase(const pack::Coating& coating, const glm::dvec3& wavelengthsNm) {
  return 2 * coating.thicknessNm / wavelengthsNm;
}

namespace {

// Reflectance of unpolarized light.
double meanReflectance(const pack::Material& m, double c, int colour, double phase) {
  const auto mean = [](const f64::Reflectance& r) { return 0.5 * (r.rs + r.rp); };
  const bool metal = pack::isConductor(m.kind);
  const double n3 = metal ? m.eta[colour] : m.eta.y, k3 = metal ? m.k[colour] : 0;
  double base = 0;
  if (m.coating.thicknessNm > 0)
    base = mean(f64::thinFilm(c, m.outsideEta, m.coating.eta[colour], phase, n3, k3).reflected);
  else
    base = mean(metal ? f64::conductorReflectance(c, m.outsideEta, n3, k3)
                      : f64::dielectricReflectance(c, m.outsideEta, n3));
  base *= m.specularFactor;
  if (m.clearCoat.factor == 0) return base;
  const f64::ClearCoat coat = metal ? f64::coatOnConductor(c, m.outsideEta, m.clearCoat.eta, n3, k3, m.specularFactor)
                                    : f64::coatOnDielectric(c, m.outsideEta, m.clearCoat.eta, n3, 1, m.specularFactor);
  return base + m.clearCoat.factor * (mean(coat.reflected) - base);
}

// Rounding error of a value that is stored in float.
float residue(double value) { return static_cast<float>(value - static_cast<double>(static_cast<float>(value))); }

gpu::MaterialExtra makeExtra(const pack::Material& m, const glm::dvec3& wavelengthsNm,
                             const std::vector<std::uint32_t>& textureRows) {
  gpu::MaterialExtra e{};
  // Only glass has an inside: the other surfaces see the outer medium from both sides.
  e.absorption = glm::vec3(m.kind == pack::MaterialKind::glass ? m.absorption : m.outsideAbsorption);
  e.outsideAbsorption = glm::vec3(m.outsideAbsorption);
  e.axis = glm::vec3(m.axis);
  e.degree = static_cast<float>(m.polarization);
  e.transmittanceParallel = glm::vec3(m.transmittanceParallel);
  e.transmittanceCrossed = glm::vec3(m.transmittanceCrossed);
  const glm::dvec3 retardance = m.retardanceDegrees * (std::numbers::pi / 180);
  e.retardanceCos = glm::vec3(glm::cos(retardance));
  e.retardanceSin = glm::vec3(glm::sin(retardance));
  e.outsideResidue = residue(m.outsideEta);
  if (m.coating.thicknessNm > 0) {
    e.filmEta = glm::vec3(m.coating.eta);
    e.filmOverOutside = glm::vec3(m.coating.eta - m.outsideEta);
    e.filmOverBase = glm::vec3(m.coating.eta - (pack::isConductor(m.kind) ? m.eta : glm::dvec3(m.eta.y)));
    for (int i = 0; i < 3; ++i) e.filmResidue[i] = residue(m.coating.eta[i]);
    e.roundTripPhase = glm::vec3(roundTripPhase(m.coating, wavelengthsNm));
  }
  e.roughness = static_cast<float>(m.roughness);
  const auto map = [&](std::int32_t index) {
    return index < 0 ? gpu::kNoTexture : textureRows[static_cast<std::size_t>(index)];
  };
  e.albedoMap = map(m.maps.albedo);
  e.etaMap = map(m.maps.eta);
  e.kMap = map(m.maps.k);
  if (m.meshMaps.eta.isUsed() || m.meshMaps.reflectance.isUsed()) e.etaMap = gpu::kMeshTexture;
  e.mapOrigin = glm::vec3(m.maps.origin);
  e.mapU = glm::vec3(m.maps.u);
  e.mapV = glm::vec3(m.maps.v);
  e.specularFactor = static_cast<float>(m.specularFactor);
  e.coatShare = static_cast<float>(m.clearCoat.factor);
  e.coatEta = static_cast<float>(m.clearCoat.eta);
  return e;
}

// Returns the indices of the meshes in the order of their origins, 0 first.
std::vector<std::uint32_t> sortByOrigin(const std::vector<pack::Mesh>& meshes) {
  const auto key = [&](std::uint32_t i) {
    const glm::dvec3& o = meshes[i].origin;
    return std::tuple(o != glm::dvec3(0.0), o.x, o.y, o.z);
  };
  std::vector<std::uint32_t> order(meshes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return order;
}

// Whether rays pass a surface unchanged, because it separates equal media.
bool isInvisible(const pack::Material& m) {
  if (m.eta.y != m.outsideEta || m.coating.thicknessNm > 0 || m.clearCoat.factor > 0) return false;
  if (!pack::isClear(m.kind) || m.transmittanceParallel != glm::dvec3(1.0)) return false;
  return !pack::hasInside(m.kind) || m.absorption == m.outsideAbsorption;
}

}  // namespace

bool sharesVertices(const RenderScene& scene, std::size_t mesh) {
  return mesh > 0 && scene.meshTransforms[mesh].kind != gpu::kUnplaced &&
         scene.meshes[mesh].firstTriangle == scene.meshes[mesh - 1].firstTriangle;
}

std::vector<MeshRun> findMeshRuns(const RenderScene& scene) {
  std::vector<MeshRun> runs;
  for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
    const gpu::Mesh& mesh = scene.meshes[i];
    const bool isPlaced = scene.meshTransforms[i].kind != gpu::kUnplaced;
    if (runs.empty()) {
      runs.push_back({i, 0, 0, isPlaced});
    } else if (const MeshRun& last = runs.back(); isPlaced) {
      const bool isShared = last.isPlaced && scene.meshes[last.first].firstTriangle == mesh.firstTriangle;
      runs.push_back({i, 0, isShared ? last.shape : last.shape + 1, true});
    } else if (mesh.origin != scene.meshes[last.first].origin) {
      runs.push_back({i, 0, last.shape + 1, false});
    }
    ++runs.back().count;
  }
  return runs;
}

glm::dvec3 hemisphereTransmittance(const pack::Material& m, const glm::dvec3& wavelengthsNm) {
  const glm::dvec3 phase = roundTripPhase(m.coating, wavelengthsNm);
  if (!pack::hasIndex(m.kind)) return glm::dvec3(1.0);
  constexpr int kSteps = 256;
  glm::dvec3 sum(0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double c = (i + 0.5) / kSteps;
    for (int colour = 0; colour < 3; ++colour) {
      sum[colour] += 2 * c * (1 - meanReflectance(m, c, colour, phase[colour])) / kSteps;
    }
  }
  return sum;
}

namespace {

gpu::Material makeMaterial(const pack::Material& m, const glm::dvec3& wavelengthsNm) {
  gpu::Material g{};
  const double basic = 1 / (m.outsideEta * m.outsideEta);
  g.eta = glm::vec3(m.eta);
  g.k = glm::vec3(m.k);
  g.contrast = glm::vec3(m.eta - m.outsideEta);
  g.radiance = glm::vec3(m.radiance * basic);
  g.albedo = !pack::isEmitter(m.kind) ? glm::vec3(m.albedo) : m.twoSided ? g.radiance : glm::vec3(0.0f);
  g.hemisphereTransmittance = glm::vec3(hemisphereTransmittance(m, wavelengthsNm));
  g.outsideEta = static_cast<float>(m.outsideEta);
  g.basicScale = static_cast<float>(basic);
  g.highlightStrength = static_cast<float>(m.highlightStrength);
  g.highlightExponent = m.highlightExponent;
  g.kind = surfaceKind(m.kind);
  return g;
}

void addLights(const pack::Scene& scene, RenderScene& result) {
  result.lights.clear();
  result.lightShapes.clear();
  const bool hasFar = std::ranges::any_of(
      scene.lights, [](const pack::LightSource& light) { return light.kind == pack::LightKind::directional; });
  const auto reach = static_cast<float>(hasFar ? lightReach(scene) : 0);
  for (const pack::LightSource& light : scene.lights) {
    result.lights.push_back({glm::vec3(light.position), glm::vec3(light.intensity)});
    const pack::SpotFalloff falloff = pack::spotFalloff(light);
    result.lightShapes.push_back({glm::vec3(light.direction), static_cast<float>(falloff.scale),
                                  static_cast<float>(falloff.offset),
                                  light.kind == pack::LightKind::directional ? reach : 0});
  }
  if (result.lightShapes.empty()) result.lightShapes.push_back({glm::vec3(0), 0, 1, 0});
}

// Adds a mesh that has the vertices and triangles added last.
void addRecord(const pack::Scene& scene, std::uint32_t source, std::uint32_t instance, const gpu::Mesh& mesh,
               const gpu::MeshTransform& transform, RenderScene& result) {
  const pack::Mesh& packed = scene.meshes[source];
  const bool isTraced = !isInvisible(scene.materials[packed.material]);
  result.meshes.push_back(mesh);
  result.meshTransforms.push_back(transform);
  result.sourceMeshes.push_back(source);
  result.sourceInstances.push_back(instance);
  result.meshTriangles.push_back(isTraced ? static_cast<std::uint32_t>(packed.triangles.size()) : 0u);
  result.meshVertices.push_back(static_cast<std::uint32_t>(packed.positions.size()));
}

gpu::Mesh addVertices(const pack::Mesh& mesh, RenderScene& result) {
  const gpu::Mesh record{static_cast<std::uint32_t>(result.triangles.size()),
                         static_cast<std::uint32_t>(result.positions.size()), mesh.material,
                         mesh.normals.empty() ? 0u : 1u, glm::vec3(mesh.origin)};
  for (const glm::dvec3& p : mesh.positions) result.positions.emplace_back(p - mesh.origin);
  result.normals.insert(result.normals.end(), mesh.normals.begin(), mesh.normals.end());
  result.normals.resize(result.positions.size(), glm::vec3(0));
  result.triangles.insert(result.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  return record;
}

void addMeshes(const pack::Scene& scene, RenderScene& result) {
  std::vector<std::vector<std::uint32_t>> instances(scene.meshes.size());
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) instances[scene.instances[i].mesh].push_back(i);
  for (const std::uint32_t source : sortByOrigin(scene.meshes)) {
    if (!instances[source].empty()) continue;
    const gpu::Mesh record = addVertices(scene.meshes[source], result);
    addRecord(scene, source, kNoInstance, record, unplacedMesh(), result);
  }
  for (std::uint32_t source = 0; source < scene.meshes.size(); ++source) {
    if (instances[source].empty()) continue;
    const pack::Mesh& mesh = scene.meshes[source];
    gpu::Mesh record = addVertices(mesh, result);
    const auto place = [&](const glm::dmat3& linear, const glm::dvec3& at, std::uint32_t instance) {
      record.origin = glm::vec3(at);
      addRecord(scene, source, instance, record, makeMeshTransform(linear, at - glm::dvec3(record.origin)), result);
    };
    place(glm::dmat3(1.0), mesh.origin, kNoInstance);
    for (const std::uint32_t i : instances[source])
      place(scene.instances[i].linear, pack::placedPoint(scene.instances[i], mesh.origin), i);
  }
  addTextureCoordinates(scene, result);
}

void addSampledLights(const pack::Scene& scene, RenderScene& result) {
  const AreaLights lights = findAreaLights(scene);
  result.areaLights.clear();
  result.lightNodes.clear();
  result.environmentDistributions.clear();
  for (const AreaLight& l : lights.lights) result.areaLights.push_back(toFloat(l));
  for (const LightNode& n : lights.nodes) result.lightNodes.push_back(toFloat(n));
  if (lights.lights.empty()) {
    result.areaLights.emplace_back();
    result.lightNodes.emplace_back();
  }
  if (scene.environment.illuminates) result.environmentDistributions = environmentDistributions(scene.environment);
  if (result.environmentDistributions.empty()) result.environmentDistributions.push_back(0);
}

}  // namespace

RenderScene makeRenderScene(const pack::Scene& scene) {
  RenderScene result;
  addTextures(scene, result);
  updateSurfaces(scene, result);
  addMeshes(scene, result);
  return result;
}

GeometryNeeds findGeometryNeeds(const pack::Scene& scene) {
  GeometryNeeds needs;
  for (const pack::Material& m : scene.materials) {
    needs.isTraced.push_back(!isInvisible(m));
    needs.hasCutOuts.push_back(m.meshMaps.coverage.isUsed());
    needs.hasNormalMaps = needs.hasNormalMaps || m.meshMaps.normal.isUsed();
    pack::visitMeshMaps(
        [&](const pack::MapRule&, const pack::MeshMap& map) {
          needs.hasMeshTextures = needs.hasMeshTextures || map.isUsed();
        },
        m.meshMaps);
  }
  return needs;
}

void updateSurfaces(const pack::Scene& scene, RenderScene& result) {
  result.materials.clear();
  result.extras.clear();
  for (const pack::Material& m : scene.materials) {
    result.materials.push_back(makeMaterial(m, scene.wavelengthsNm));
    result.extras.push_back(makeExtra(m, scene.wavelengthsNm, result.textureRows));
  }
  addMeshMaps(scene, result);
  addLights(scene, result);
  result.environmentTexels = scene.environment.texels;
  if (result.environmentTexels.empty()) result.environmentTexels.emplace_back(0.0f);
  addSampledLights(scene, result);
}

double lightReach(const pack::Scene& scene) {
  const pack::Box box = pack::sceneBox(scene);
  return box.isEmpty() ? 1 : std::max(2 * glm::length(box.high - box.low), 1e-3);
}

glm::dvec2 facetPoint(std::size_t i) {
  // Vogel's spiral: equal areas, each point rotated by the golden angle.
  const double radius = std::sqrt((static_cast<double>(i) + 0.5) / gpu::kFacets),
               angle = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5.0));
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

namespace {

// The coarse part is a multiple of `unit`, the fine one the rest.
void split(const glm::dvec3& v, double unit, glm::vec3& coarse, glm::vec3& fine) {
  const glm::dvec3 rounded = glm::round(v / unit) * unit;
  coarse = glm::vec3(rounded);
  fine = glm::vec3(v - rounded);
}

// The points of cameraSampleDirection and cameraSampleOffset: middle + (2 px - 1) halfWidth right + (1 - 2 py)
// halfHeight up of the image plane, at the centres of the samples.
void setSamples(gpu::CameraParameters& f, const pack::Camera& camera, const RenderParameters& parameters) {
  const double columns = static_cast<double>(parameters.width) * parameters.samples,
               rows = static_cast<double>(parameters.height) * parameters.samples;
  const ImagePlane plane = makeImagePlane(camera, parameters.width, parameters.height);
  const glm::dvec3 right = camera.right * plane.halfWidth, up = camera.up * plane.halfHeight,
                   columnStep = right * (2 / columns), rowStep = up * (-2 / rows),
                   first = plane.middle - right + up + 0.5 * (columnStep + rowStep);
  // No partial sum of coarse parts exceeds 2^24 units, so that float represents it.
  const glm::dvec3 sizes = glm::abs(first) + 2.0 * (glm::abs(right) + glm::abs(up));
  const double unit = std::exp2(std::ceil(std::log2(std::max({sizes.x, sizes.y, sizes.z}))) - 23);
  split(first, unit, f.firstSample, f.firstSampleFine);
  split(columnStep, unit, f.columnStep, f.columnStepFine);
  split(rowStep, unit, f.rowStep, f.rowStepFine);
}

void setSampledLights(gpu::CameraParameters& f, const pack::Scene& scene, const RenderParameters& parameters) {
  const AreaLightCount lights = countAreaLights(scene);
  f.areaLightCount = static_cast<int>(lights.lights);
  f.lightLevels = static_cast<int>(lights.levels);
  f.lightSamples = parameters.lightSamples;
  f.environmentLight = scene.environment.illuminates ? 1 : 0;
  if (scene.environment.illuminates) f.ambientIrradiance = 0;
  f.environmentStep = std::bit_floor(scene.environment.size);
  f.lightReach = static_cast<float>(lightReach(scene));
  f.filteredShadows = filtersShadows(scene, parameters) ? 1 : 0;
}

}  // namespace

CameraCone cameraCone(const pack::Camera& camera, const RenderParameters& parameters) {
  const ImagePlane plane = makeImagePlane(camera, parameters.width, parameters.height);
  const double size =
      2 * std::sqrt(plane.halfWidth / parameters.width * plane.halfHeight / parameters.height) / parameters.samples;
  return camera.isOrthographic() ? CameraCone{size, 0} : CameraCone{0, size};
}

gpu::CameraParameters makeCameraParameters(const pack::Scene& scene, const RenderParameters& parameters) {
  gpu::CameraParameters f{};
  const pack::Camera& camera = scene.camera;
  f.position = glm::vec3(camera.position);
  f.up = glm::vec3(camera.up);
  f.forward = glm::vec3(camera.forward);
  f.orthographic = camera.isOrthographic() ? 1 : 0;
  const CameraCone cone = cameraCone(camera, parameters);
  f.coneWidth = static_cast<float>(cone.width);
  f.coneSpread = static_cast<float>(cone.spread);
  setSamples(f, camera, parameters);
  f.basicToRadiance = static_cast<float>(camera.mediumEta * camera.mediumEta);
  for (int i = 0; i < 4; ++i) f.analyser[i] = static_cast<float>(parameters.analyser[static_cast<std::size_t>(i)]);
  f.width = parameters.width;
  f.height = parameters.height;
  f.regionX = parameters.region.x;
  f.regionY = parameters.region.y;
  f.regionWidth = parameters.region.width;
  f.regionHeight = parameters.region.height;
  f.samples = parameters.samples;
  f.depth = static_cast<int>(parameters.depth);
  f.lightCount = static_cast<int>(scene.lights.size());
  f.environmentSize = static_cast<int>(scene.environment.size);
  f.environment = glm::vec3(scene.environment.radiance);
  f.ambientIrradiance = static_cast<float>(scene.environment.ambientIrradiance);
  f.shadows = parameters.shadows ? 1 : 0;
  f.sun = glm::vec3(scene.environment.sun);
  f.skyDegree = static_cast<float>(scene.environment.skyDegree);
  f.tolerance = static_cast<float>(parameters.tolerance);
  setSampledLights(f, scene, parameters);
  for (std::size_t i = 0; i < gpu::kFacets; ++i) f.facets[i] = glm::vec2(facetPoint(i));
  for (int i = 0; i < 9; ++i) f.irradiance[i] = glm::vec3(scene.environment.irradiance[static_cast<std::size_t>(i)]);
  return f;
}

}  // namespace malus::render
