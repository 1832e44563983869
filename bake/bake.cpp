#include "bake/bake.h"

#include <cmath>
#include <limits>

#include <draco/core/draco_version.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "bake/effects/effects.h"
#include "bake/environment/octahedral_map.h"
#include "bake/image/image.h"
#include "bake/imports/import.h"
#include "bake/pack/format.h"
#include "bake/pack/reader.h"
#include "bake/placement/placement.h"
#include "bake/textures/texture.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/prepare.h"
#include "meshprep/read/read_mesh.h"
#include "meshprep/read/source_scene.h"

namespace malus::bake {

namespace {

std::string hashText(const std::filesystem::path& file) { return fmt::format("{:016x}", pack::hashOf(readFile(file))); }

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

void requireClosedGlass(const std::filesystem::path& file, const std::string& name, const pack::Material& material,
                        const prep::Report& report) {
  if (material.kind != pack::MaterialKind::glass) return;
  for (std::size_t i = 0; i < report.components.size(); ++i)
    if (!report.components[i].closed)
      throw Error(file.string(), fmt::format("mesh '{}': component {} of a glass body is open", name, i),
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
  // What an imported file refers to may be missing: that is told where it is read.
  const auto addReferenced = [&](const std::filesystem::path& file) {
    std::error_code ignored;
    for (const std::filesystem::path& other : prep::referencedFiles(file))
      if (std::filesystem::exists(other, ignored))
        addRelative(other);
      else
        sources.push_back({{"file", other.lexically_relative(d.file.parent_path()).string()}, {"xxh3", "missing"}});
  };
  for (const MeshDescription& mesh : d.meshes) {
    addRelative(mesh.file);
    if (prep::isGltf(mesh.file)) addReferenced(mesh.file);
  }
  for (const ImportDescription& import : d.imports) {
    addRelative(import.file);
    addReferenced(import.file);
  }
  if (!d.environmentImage.empty()) addRelative(d.environmentImage);
  for (const TextureDescription& texture : d.textures) addRelative(texture.file);
  return nlohmann::json{
      {"malus", MALUS_VERSION},
      {"baker", kBakerRevision},
      {"draco", std::string(draco::kDracoVersion)},
      {"sources", sources},
      {"settings", {{"positionBits", settings.positionBits}, {"normalBits", settings.normalBits}}},
  }
      .dump();
}

bool isUpToDate(const std::filesystem::path& pack, const std::string& provenance) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(pack, ignored)) return false;
  try {
    return pack::read(pack).scene.provenance == provenance;
  } catch (const Error&) {  // damaged, or no pack: it is made anew
    return false;
  }
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
  const auto place = [&](const prep::Mesh& mesh, const glm::dmat4& worldFromObject, pack::Mesh packed) {
    if (scene.meshes.size() == pack::kMaxMeshes)
      throw Error(d.file.string(), "has too many meshes", fmt::format("at most {}", pack::kMaxMeshes));
    world.push_back(placed(mesh, worldFromObject));
    for (const glm::dvec3& p : world.back().positions) low = glm::min(low, p), high = glm::max(high, p);
    scene.meshes.push_back(std::move(packed));
  };
  UniqueNames meshNames, materialNames;
  for (const pack::Material& material : d.materials) materialNames.take(material.name);
  for (const MeshDescription& mesh : d.meshes) {
    progress(fmt::format("preparing {}", mesh.name));
    prep::Options options;
    options.flat = mesh.flat;
    options.sheet = mesh.sheet;
    options.asIs = mesh.asIs;
    options.creaseDegrees = mesh.creaseDegrees;
    options.weldTolerance = mesh.weldTolerance;
    const prep::Polygons polygons = prep::readMesh(mesh.file);
    for (const std::string& note : polygons.notes) baked.notes.push_back(noteOf(mesh.file, note));
    prep::Report report;
    const prep::Mesh prepared = prep::prepare(polygons, mesh.file.string(), options, report);
    std::uint32_t material = 0;
    while (d.materials[material].name != mesh.material) ++material;
    if (mesh.asIs && !mesh.sheet && d.materials[material].kind == pack::MaterialKind::glass)
      throw Error(mesh.file.string(), fmt::format("mesh '{}': a glass body that is taken as it is", mesh.name),
                  "\"sheet\": true beside \"asIs\": true, because nobody checks that it is closed");
    if (!mesh.sheet) requireClosedGlass(mesh.file, mesh.name, d.materials[material], report);
    baked.reports.push_back(std::move(report));
    for (std::size_t i = 0; i < mesh.instances.size(); ++i) {
      pack::Mesh packed;
      packed.name = mesh.instances.size() == 1 ? mesh.name : fmt::format("{}.{}", mesh.name, i + 1);
      meshNames.take(packed.name);
      packed.material = material;
      packed.sheet = mesh.sheet;
      place(prepared, matrixOf(mesh.instances[i]), std::move(packed));
    }
  }
  for (const ImportDescription& import : d.imports) {
    progress(fmt::format("preparing {}", import.file.filename().string()));
    Imported imported = importScene(import, scene.materials, materialNames, meshNames);
    for (ImportedMesh& mesh : imported.meshes) {
      const ImportedPart& part = imported.parts[mesh.part];
      if (!mesh.sheet) requireClosedGlass(import.file, mesh.name, scene.materials[mesh.material], part.report);
      pack::Mesh packed;
      packed.name = std::move(mesh.name);
      packed.material = mesh.material;
      packed.sheet = mesh.sheet;
      place(part.mesh, mesh.worldFromObject, std::move(packed));
    }
    for (ImportedPart& part : imported.parts) baked.reports.push_back(std::move(part.report));
    baked.notes.insert(baked.notes.end(), imported.notes.begin(), imported.notes.end());
  }

  // Everything relative to the origin, then to float.
  scene.origin = d.origin.value_or((low + high) * 0.5);
  for (std::size_t i = 0; i < world.size(); ++i) {
    pack::Mesh& mesh = scene.meshes[i];
    for (const glm::dvec3& p : world[i].positions) mesh.positions.emplace_back(p - scene.origin);
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
