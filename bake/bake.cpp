#include "bake/bake.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <draco/core/draco_version.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <nlohmann/json.hpp>

#include "bake/effects/effects.h"
#include "bake/environment/octahedral_map.h"
#include "bake/image/image.h"
#include "bake/pack/format.h"
#include "bake/textures/texture.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/prepare.h"

namespace malus::bake {

namespace {

std::string hashText(const std::filesystem::path& file) { return fmt::format("{:016x}", pack::hashOf(readFile(file))); }

glm::dmat3 linearPart(const Transform& transform) {
  glm::dmat3 m(1.0);
  for (int axis = 0; axis < 3; ++axis) m[axis][axis] = transform.scale[axis];
  for (int axis = 0; axis < 3; ++axis) {
    const double a = transform.rotateDegrees[axis] * std::numbers::pi / 180;
    // Quarter turns are exact, so that what touches keeps touching.
    const double quarter = transform.rotateDegrees[axis] / 90;
    const bool exact = quarter == std::floor(quarter);
    const double c = exact ? std::round(std::cos(a)) : std::cos(a), s = exact ? std::round(std::sin(a)) : std::sin(a);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    glm::dmat3 turn(1.0);
    turn[u][u] = c, turn[u][v] = s, turn[v][u] = -s, turn[v][v] = c;
    m = turn * m;
  }
  return m;
}

// In world space, double precision; rounding to float comes after the origin is taken off.
prep::Mesh placed(const prep::Mesh& mesh, const Transform& transform) {
  const glm::dmat3 m = linearPart(transform);
  const glm::dmat3 normalMatrix(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                                glm::cross(m[0], m[1]));  // det * inverse transpose
  const bool mirrors = glm::dot(m[0], glm::cross(m[1], m[2])) < 0;
  prep::Mesh result = mesh;
  for (glm::dvec3& p : result.positions) p = m * p + transform.translate;
  for (glm::vec3& n : result.normals) {
    glm::dvec3 turned = normalMatrix * glm::dvec3(n);
    if (mirrors) turned = -turned;
    n = glm::vec3(glm::normalize(turned));
  }
  if (mirrors)
    for (glm::uvec3& t : result.triangles) std::swap(t.y, t.z);
  return result;
}

pack::Camera cameraOf(const SceneDescription& d, const glm::dvec3& origin) {
  pack::Camera camera;
  const glm::dvec3 toTarget = d.cameraTarget - d.cameraPosition;
  if (glm::length(toTarget) == 0)
    throw Error(d.file.string(), "camera.target: is the camera's position", "another point");
  camera.position = d.cameraPosition - origin;
  camera.forward = glm::normalize(toTarget);
  const glm::dvec3 right = glm::cross(camera.forward, d.cameraUp);
  if (glm::length(right) <= 1e-9 * glm::length(d.cameraUp))
    throw Error(d.file.string(), "camera.up: points along the view", "another direction");
  camera.right = glm::normalize(right);
  camera.up = glm::cross(camera.right, camera.forward);
  camera.verticalFovDegrees = d.verticalFovDegrees;
  camera.mediumEta = d.mediumEta;
  return camera;
}

void requireClosedGlass(const MeshDescription& mesh, const pack::Material& material, const prep::Report& report) {
  if (material.kind != pack::MaterialKind::glass || mesh.sheet) return;
  if (mesh.asIs)
    throw Error(mesh.file.string(), fmt::format("mesh '{}': a glass body that is taken as it is", mesh.name),
                "\"sheet\": true beside \"asIs\": true, because nobody checks that it is closed");
  for (std::size_t i = 0; i < report.components.size(); ++i)
    if (!report.components[i].closed)
      throw Error(mesh.file.string(), fmt::format("mesh '{}': component {} of a glass body is open", mesh.name, i),
                  "a closed surface, or \"sheet\": true");
}

// Where the axis of a sheet or a display points along a face's normal, light has no direction across the ray.
void requireAxisInPlane(const pack::Mesh& mesh, const pack::Material& material, const std::filesystem::path& file) {
  if (material.axis == glm::dvec3(0.0)) return;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::dvec3 p0(mesh.positions[t.x]),
        across = glm::cross(glm::dvec3(mesh.positions[t.y]) - p0, glm::dvec3(mesh.positions[t.z]) - p0);
    const double length = glm::length(across);
    if (length > 0 && std::abs(glm::dot(across / length, material.axis)) > 1 - 1e-6)
      throw Error(file.string(),
                  fmt::format("mesh '{}': face {} is at right angles to its material's axis", mesh.name, i),
                  fmt::format("an axis of '{}' that lies across the normals of its faces", material.name));
  }
}

template <class T>
nlohmann::json orNull(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

}  // namespace

std::string provenanceOf(const SceneDescription& d, const pack::WriteSettings& settings) {
  nlohmann::json sources = nlohmann::json::array();
  const auto add = [&](const std::filesystem::path& file, const std::string& name) {
    sources.push_back({{"file", name}, {"xxh3", hashText(file)}});
  };
  const auto addRelative = [&](const std::filesystem::path& file) {
    add(file, file.lexically_relative(d.file.parent_path()).string());
  };
  add(d.file, d.file.filename().string());
  for (const MeshDescription& mesh : d.meshes) addRelative(mesh.file);
  if (!d.environmentImage.empty()) addRelative(d.environmentImage);
  for (const TextureDescription& texture : d.textures) addRelative(texture.file);
  return nlohmann::json{
      {"malus", MALUS_VERSION},
      {"baker", kBakerRevision},
      {"draco", std::string(draco::kDracoVersion)},
      {"sources", sources},
      {"settings",
       {{"maxError", orNull(settings.bounds.maxError)},
        {"maxNormalErrorDegrees", orNull(settings.bounds.maxNormalErrorDegrees)},
        {"positionBits", orNull(settings.bounds.positionBits)},
        {"normalBits", orNull(settings.bounds.normalBits)},
        {"keepMap", settings.keepMap}}},
  }
      .dump();
}

Baked bake(const SceneDescription& d, const pack::WriteSettings& settings,
           const std::function<void(std::string_view)>& progress) {
  Baked baked;
  pack::Scene& scene = baked.scene;
  scene.name = d.name;
  scene.title = d.title;
  scene.width = d.width;
  scene.height = d.height;
  scene.depth = d.depth;
  scene.exposureEv = d.exposureEv;
  scene.materials = d.materials;

  // Meshes in world space.
  std::vector<prep::Mesh> world;
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const MeshDescription& mesh : d.meshes) {
    progress(fmt::format("preparing {}", mesh.name));
    prep::Options options;
    options.flat = mesh.flat;
    options.sheet = mesh.sheet;
    options.asIs = mesh.asIs;
    options.creaseDegrees = mesh.creaseDegrees;
    options.steps.weldTolerance = mesh.weldTolerance;
    prep::Report report;
    const prep::Mesh prepared = prep::prepare(mesh.file, options, report);
    std::uint32_t material = 0;
    while (d.materials[material].name != mesh.material) ++material;
    requireClosedGlass(mesh, d.materials[material], report);
    baked.reports.push_back(std::move(report));
    for (std::size_t i = 0; i < mesh.instances.size(); ++i) {
      world.push_back(placed(prepared, mesh.instances[i]));
      for (const glm::dvec3& p : world.back().positions) low = glm::min(low, p), high = glm::max(high, p);
      pack::Mesh packed;
      packed.name = mesh.instances.size() == 1 ? mesh.name : fmt::format("{}.{}", mesh.name, i + 1);
      packed.material = material;
      packed.sheet = mesh.sheet;
      if (settings.keepMap) packed.sourceVertices = prepared.sourceVertices, packed.sourceFaces = prepared.sourceFaces;
      scene.meshes.push_back(std::move(packed));
    }
  }

  // Everything relative to the origin, then to float.
  scene.origin = d.origin.value_or((low + high) * 0.5);
  for (std::size_t i = 0; i < world.size(); ++i) {
    pack::Mesh& mesh = scene.meshes[i];
    for (const glm::dvec3& p : world[i].positions) {
      const glm::dvec3 local = p - scene.origin;
      mesh.positions.emplace_back(local);
      baked.moved = std::max(baked.moved, glm::distance(local, glm::dvec3(mesh.positions.back())));
    }
    mesh.normals = std::move(world[i].normals);
    mesh.triangles = std::move(world[i].triangles);
    requireAxisInPlane(mesh, scene.materials[mesh.material], d.file);
  }
  scene.camera = cameraOf(d, scene.origin);
  for (const pack::PointLight& light : d.lights)
    scene.lights.push_back({light.position - scene.origin, light.intensity});

  // Light from infinity.
  scene.environment.diffuseFill = d.diffuseFill;
  if (d.environmentImage.empty()) {
    bakeConstantEnvironment(d.environmentRadiance, scene.environment);
    if (d.sun != glm::dvec3(0.0)) bakeRayleighIrradiance(d.sun, scene.environment);
  } else {
    progress("baking the environment");
    bakeEnvironment(image::read(d.environmentImage), d.environmentImage.string(), d.environmentScale,
                    d.environmentRotationDegrees, scene.environment);
  }
  scene.environment.sun = d.sun;
  scene.environment.skyDegree = d.skyDegree;

  // Pictures of materials.
  for (const TextureDescription& texture : d.textures) {
    const std::string name = texture.file.lexically_relative(d.file.parent_path()).string();
    progress(fmt::format("baking {}", name));
    scene.textures.push_back(bakeTexture(image::read(texture.file), texture, name));
  }
  for (pack::Material& m : scene.materials) m.maps.origin -= m.maps.any() ? scene.origin : glm::dvec3(0.0);
  scene.effects = findEffects(scene);

  scene.provenance = provenanceOf(d, settings);
  return baked;
}

}  // namespace malus::bake
