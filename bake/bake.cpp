#include "bake/bake.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include <draco/core/draco_version.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "bake/camera.h"
#include "bake/effects/effects.h"
#include "bake/environment/octahedral_map.h"
#include "bake/environment/studio.h"
#include "bake/materials/absorption_precision.h"
#include "bake/materials/film_precision.h"
#include "bake/meshes/coincident_faces.h"
#include "bake/meshes/instances.h"
#include "bake/meshes/meshes.h"
#include "bake/model/model_scene.h"
#include "bake/pack/format.h"
#include "bake/pack/instances.h"
#include "bake/placement/placement.h"
#include "bake/textures/texture.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image.h"
#include "meshprep/base/text.h"
#include "meshprep/json_text.h"
#include "meshprep/read/source_scene.h"

namespace malus::bake {

namespace {

std::string hashText(const std::filesystem::path& file) {
  return fmt::format("{:016x}", pack::hashBytes(readFile(file)));
}

pack::Camera makeCamera(const SceneDescription& d, const glm::dvec3& origin) {
  pack::Camera camera;
  // Subtract the rounded origin from the position only, so that the direction is exact.
  placeCamera(d.cameraPosition, d.cameraTarget, d.cameraUp, d.file.string(), camera);
  camera.position = d.cameraPosition - origin;
  camera.verticalFovDegrees = d.verticalFovDegrees;
  camera.orthographicHeight = d.orthographicHeight;
  if (d.intrinsics) setIntrinsics(*d.intrinsics, d.width, d.height, d.file.string(), camera);
  camera.mediumEta = d.mediumEta;
  return camera;
}

// Throws Error if the axis of a polarizing element or a polarized emitter is parallel to the normal of a face: its
// projection across a ray along the normal has no direction. linear: of the mesh's transform.
void requireAxisInPlane(const pack::Mesh& mesh, const glm::dmat3& linear, const std::vector<pack::Material>& materials,
                        const std::filesystem::path& file) {
  const pack::Material& material = materials[mesh.material];
  if (material.axis == glm::dvec3(0.0)) return;
  const glm::dmat3 normalMatrix = pack::cofactors(linear);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::dvec3 p0 = mesh.positions[t.x],
                     across = normalMatrix * glm::cross(mesh.positions[t.y] - p0, mesh.positions[t.z] - p0);
    const double length = glm::length(across);
    if (length > 0 && std::abs(glm::dot(across / length, material.axis)) > 1 - 1e-6)
      throw Error(file.string(),
                  fmt::format("mesh '{}': the normal of face {} is parallel to the axis of its material", mesh.name, i),
                  fmt::format("another axis of material '{}'", material.name));
  }
}

template <class T>
nlohmann::json orNull(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

}  // namespace

std::vector<SourceFile> sourceFiles(const SceneDescription& d) {
  std::vector<SourceFile> files = {{d.file}};
  const auto addReferenced = [&](const std::filesystem::path& file) {
    for (const std::filesystem::path& other : prep::referencedFiles(file)) files.push_back({other, true});
  };
  for (const MeshDescription& mesh : d.meshes) {
    files.push_back({mesh.file});
    if (prep::isGltf(mesh.file)) addReferenced(mesh.file);
  }
  for (const ImportDescription& import : d.imports) {
    files.push_back({import.file});
    addReferenced(import.file);
  }
  if (!d.environmentImage.empty()) files.push_back({d.environmentImage});
  for (const TextureDescription& texture : d.textures) files.push_back({texture.file});
  for (const std::filesystem::path& file : d.opticalFiles) files.push_back({file});
  return files;
}

std::string makeProvenance(const SceneDescription& d, const pack::WriteSettings& settings, const BakeOptions& options) {
  nlohmann::json sources = nlohmann::json::array();
  for (const SourceFile& source : sourceFiles(d)) {
    std::error_code ignored;
    const bool isMissing = source.mayBeMissing && !std::filesystem::exists(source.file, ignored);
    sources.push_back({{"file", source.file == d.file ? d.file.filename().string()
                                                      : source.file.lexically_relative(d.file.parent_path()).string()},
                       {"xxh3", isMissing ? "missing" : hashText(source.file)}});
  }
  nlohmann::json provenance = {
      {"malus", MALUS_VERSION},
      {"baker", kBakerRevision},
      {"draco", std::string(draco::kDracoVersion)},
      {"sources", sources},
      {"settings",
       {{"maxError", orNull(settings.bounds.positionError)},
        {"maxNormalErrorDegrees", orNull(settings.bounds.normalErrorDegrees)},
        {"positionBits", orNull(settings.bounds.positionBits)},
        {"normalBits", orNull(settings.bounds.normalBits)},
        {"keepMap", settings.keepMap},
        {"allowOpenGlass", options.allowOpenGlass},
        {"strict", options.strict}}},
      {"warnings", nlohmann::json::array()},
  };
  if (settings.bounds.uvErrorTexels)  // packs without it keep their bytes
    provenance["settings"]["maxUvErrorTexels"] = *settings.bounds.uvErrorTexels;
  if (d.model) provenance["model"] = {{"camera", d.model->camera}};
  return jsonText(provenance, -1);
}

std::string withWarnings(const std::string& provenance, std::vector<std::string> warnings) {
  constexpr std::size_t kMost = 1000;  // so that the section stays below its largest size
  for (std::string& warning : warnings) warning = printable(warning).substr(0, 1000);
  if (warnings.size() > kMost) {
    const std::size_t left = warnings.size() - kMost;
    warnings.resize(kMost);
    warnings.push_back(fmt::format("and {} more; 'malus bake --force' prints them", left));
  }
  nlohmann::json document = nlohmann::json::parse(provenance);
  document["warnings"] = warnings;
  return jsonText(document, -1);
}

// Reports thin films that the single-precision renderers do not reproduce.
void addFilmNotes(const pack::Scene& scene, std::vector<std::string>& notes) {
  for (const pack::Material& m : scene.materials)
    if (const auto film = insufficientFilmPrecision(m, scene.wavelengthsNm))
      notes.push_back(fmt::format(
          "material '{}': the thin film has an optical thickness of {:.3g} wavelengths: the single-precision renderers "
          "(embree, vulkan) differ from double precision by up to {:.1e} in reflectance; expected at most {:g}, up to "
          "{:.3g} wavelengths",
          m.name, film->waves, film->difference, kFilmPrecision, film->limitWaves));
}

// Reports media whose absorption the single-precision renderers do not reproduce, the worst mesh of each material.
void addAbsorptionNotes(const pack::Scene& scene, std::vector<std::string>& notes) {
  std::map<std::uint32_t, std::pair<std::string, AbsorptionPrecision>> worst;
  const auto inspect = [&](const pack::Mesh& mesh) {
    if (const auto found = insufficientAbsorptionPrecision(mesh, scene.materials[mesh.material]);
        found && (!worst.contains(mesh.material) || worst.at(mesh.material).second.error < found->error))
      worst.insert_or_assign(mesh.material, std::pair(mesh.name, *found));
  };
  for (const pack::Mesh& mesh : scene.meshes) inspect(mesh);
  for (const pack::Instance& instance : scene.instances)
    if (absorbs(scene.materials[scene.meshes[instance.mesh].material])) inspect(pack::placedMesh(scene, instance));
  for (const auto& [material, named] : worst) {
    const auto& [mesh, found] = named;
    const std::string subject =
        fmt::format("material '{}': the single-precision renderers (embree, vulkan)", scene.materials[material].name);
    notes.push_back(
        found.thickness > 0
            ? fmt::format(
                  "{} start rays up to {:.1e} m off the faces of mesh '{}', beyond its mean thickness of {:.1e} m: "
                  "its medium is missed; expected a thicker body or a smaller one: use thin-glass, or --backend "
                  "reference",
                  subject, found.distance, mesh, found.thickness)
            : fmt::format(
                  "{} take ways through its medium wrong by up to {:.1e} m at mesh '{}', a relative error of {:.1e} "
                  "of the transmittance; expected at most {:g}: use smaller meshes or faces parallel to the axes, "
                  "or --backend reference",
                  subject, found.distance, mesh, found.error, kAbsorptionPrecision));
  }
}

// Reports light that single precision, in renderers and image files, takes for 0, or that it loses by a few
// reflections: the smallest normal float is 1.2e-38.
void addFaintLightNotes(const pack::Scene& scene, std::vector<std::string>& notes) {
  constexpr double kFaintest = 1e-30;
  const auto check = [&](const std::string& what, const glm::dvec3& light, const char* remedy) {
    const double largest = std::max({light.x, light.y, light.z});
    if (largest > 0 && largest < kFaintest)
      notes.push_back(
          fmt::format("{}: the largest value is {:.3g}, and values below 1.2e-38 become 0 in single precision; "
                      "expected at least {:g}: {}, and lower exposureEv",
                      what, largest, kFaintest, remedy));
  };
  check("environment", scene.environment.irradiance[0] / std::numbers::pi, "raise its radiance or 'scale'");
  for (const pack::Material& m : scene.materials)
    if (pack::isEmitter(m.kind)) check(fmt::format("material '{}'", m.name), m.radiance, "raise its radiance");
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    check(fmt::format("light {}", i), scene.lights[i].intensity, "raise its intensity");
}

// Adds the meshes and instances, relative to the scene's origin. Throws Error: more meshes than a pack can contain, an
// axis across a face.
void addMeshes(const SceneDescription& d, bool keepMap, std::vector<PlacedMesh> placed, const InstanceChoice& choice,
               Baked& baked) {
  pack::Scene& scene = baked.scene;
  std::vector<std::uint32_t> stored(placed.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    PlacedMesh& source = placed[i];
    if (const std::size_t first = choice.first[i]; first != i) {
      pack::Instance& instance = scene.instances.emplace_back();
      instance.name = std::move(source.packed.name);
      instance.mesh = stored[first];
      setPlace(placed[first].worldFromObject, source.worldFromObject, scene.origin, instance);
      requireAxisInPlane(scene.meshes[instance.mesh], instance.linear, scene.materials, d.file);
      continue;
    }
    if (scene.meshes.size() == pack::kMaxMeshes)
      throw Error(d.file.string(), "has too many meshes", fmt::format("at most {}", pack::kMaxMeshes));
    if (source.isGlassBody) baked.glassBodies.push_back(scene.meshes.size());
    stored[i] = static_cast<std::uint32_t>(scene.meshes.size());
    pack::Mesh& mesh = scene.meshes.emplace_back(std::move(source.packed));
    prep::Mesh world = bake::placed(*source.source, source.worldFromObject);
    mesh.positions = std::move(world.positions);
    for (glm::dvec3& p : mesh.positions) p -= scene.origin;
    mesh.normals = std::move(world.normals);
    mesh.textureCoordinates = std::move(world.textureCoordinates);
    mesh.tangents = std::move(world.tangents);
    mesh.triangles = std::move(world.triangles);
    if (keepMap) mesh.sourceVertices = source.source->sourceVertices, mesh.sourceFaces = source.source->sourceFaces;
    requireAxisInPlane(mesh, glm::dmat3(1.0), scene.materials, d.file);
  }
}

// Light from infinity.
void addEnvironment(const SceneDescription& d, const std::function<void(std::string_view)>& progress,
                    pack::Environment& environment, std::vector<std::string>& notes) {
  environment.ambientIrradiance = d.ambientIrradiance;
  environment.illuminates = d.environmentIlluminates;
  if (d.environmentImage.empty() && d.environmentPreset.empty()) {
    bakeConstantEnvironment(d.environmentRadiance, environment);
    if (d.sun != glm::dvec3(0.0)) bakeRayleighIrradiance(d.sun, environment);
  } else {
    progress("baking the environment");
    const bool isPreset = d.environmentImage.empty();
    bakeEnvironment(isPreset ? studioImage() : image::read(d.environmentImage),
                    isPreset ? d.environmentPreset : d.environmentImage.string(), d.environmentScale,
                    d.environmentRotationDegrees, environment, notes);
  }
  environment.sun = d.sun;
  environment.skyDegree = d.skyDegree;
}

Baked bake(const SceneDescription& asked, const pack::WriteSettings& settings,
           const std::function<void(std::string_view)>& progress, const BakeOptions& options) {
  Baked baked;
  baked.description = asked;
  SceneDescription& d = baked.description;
  pack::Scene& scene = baked.scene;
  scene.wavelengthsNm = d.wavelengthsNm;
  scene.materials = d.materials;

  // Textures of the description, which imports add theirs to.
  std::vector<std::string> textureNotes;
  for (const TextureDescription& texture : d.textures) {
    const std::string name = texture.file.lexically_relative(d.file.parent_path()).string();
    progress(fmt::format("baking {}", name));
    scene.textures.push_back(bakeTexture(image::read(texture.file), texture, name, textureNotes));
  }

  // Meshes in world space.
  PlacedMeshes placed = placeMeshes(d, {options.allowOpenGlass, settings.keepMap, options.strict}, scene.materials,
                                    scene.textures, progress);
  baked.reports = std::move(placed.reports);
  baked.notes = std::move(placed.notes);
  addFilmNotes(scene, baked.notes);
  const InstanceChoice instances = chooseInstances(placed.meshes, scene.materials);
  const pack::Box box = instances.box;
  if (d.model)
    completeModel(d, {std::move(placed.cameras), std::move(placed.lights), box.low, box.high}, baked.notes,
                  baked.choices);
  baked.choices.insert(baked.choices.end(), instances.reasons.begin(), instances.reasons.end());
  scene.name = d.name;
  scene.title = d.title;
  scene.width = d.width;
  scene.height = d.height;
  scene.depth = d.depth;
  scene.exposureEv = d.exposureEv;

  // Make positions relative to the origin. Writing the pack rounds them to a grid.
  scene.origin = d.origin.value_or((box.low + box.high) * 0.5);
  addMeshes(d, settings.keepMap, std::move(placed.meshes), instances, baked);
  addAbsorptionNotes(scene, baked.notes);
  scene.camera = makeCamera(d, scene.origin);
  scene.lights = d.lights;
  for (pack::LightSource& light : scene.lights)
    if (light.kind != pack::LightKind::directional) light.position -= scene.origin;

  addEnvironment(d, progress, scene.environment, baked.notes);
  addFaintLightNotes(scene, baked.notes);

  baked.notes.insert(baked.notes.end(), textureNotes.begin(), textureNotes.end());
  for (pack::Material& m : scene.materials) m.maps.origin -= m.maps.any() ? scene.origin : glm::dvec3(0.0);
  for (std::string& warning : inspectBodies(scene, baked.glassBodies, options.allowOpenGlass))
    baked.notes.push_back(std::move(warning));
  for (std::string& warning : inspectCoincidentFaces(scene)) baked.notes.push_back(std::move(warning));
  scene.effects = findEffects(scene);

  scene.provenance = makeProvenance(asked, settings, options);
  return baked;
}

}  // namespace malus::bake
