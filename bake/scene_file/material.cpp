#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "bake/materials/dielectric_k.h"
#include "bake/materials/optical_file.h"
#include "bake/materials/presets.h"
#include "bake/pack/material_fields.h"
#include "bake/scene_file/key_reader.h"
#include "bake/scene_file/parts.h"
#include "bake/scene_file/scene_keys.h"
#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"

namespace malus::bake {

namespace {

pack::MaterialKind readKind(StrictObject& object) {
  const std::string type = object.text("type");
  if (const auto kind = pack::findMaterialKind(type)) return *kind;
  std::vector<std::string> names;
  names.reserve(std::size(pack::kMaterialKinds));
  for (const pack::MaterialKindInfo& info : pack::kMaterialKinds) names.emplace_back(info.name);
  object.fail("type", fmt::format("unknown type of material{}", nearestClause(type, names)),
              fmt::format("{}", fmt::join(names, ", ")), fmt::format("'{}'", type));
}

// The constants of a preset, or of a file, which is added to those of the scene.
OpticalConstants readPreset(StrictObject& object, SceneDescription& scene) {
  const std::string name = object.text("preset");
  try {
    if (!isOpticalFile(name)) return requirePreset(name).at(scene.wavelengthsNm);
    const std::filesystem::path file = scene.file.parent_path() / name;
    scene.opticalFiles.push_back(file);
    return readOpticalFile(file).at(scene.wavelengthsNm);
  } catch (const Error& error) {
    object.fail("preset", error.what(), "");
  }
}

void convertK(StrictObject& object, const glm::dvec3& wavelengthsNm, pack::Material& m) try {
  convertDielectricK(wavelengthsNm, m);
} catch (const Error& error) {
  object.fail("preset", error.what(), "");
}

// The index eta - i k: of a preset or file, or eta and k.
void readIndex(StrictObject& object, pack::Material& m, SceneDescription& scene) {
  const bool dielectric = pack::isDielectric(m.kind), preset = object.has("preset"), eta = object.has("eta");
  // Paint has a default, and an opaque dielectric may have its index in a texture instead.
  const bool optional =
      dielectric && pack::canHaveIndexMap(m.kind) && (pack::canBeDiffuse(m.kind) || object.has("etaMap"));
  if (preset && (eta || object.has("k"))) object.fail("preset", "and eta, k exclude each other", "one of the two");
  if (preset) {
    const OpticalConstants constants = readPreset(object, scene);
    m.eta = constants.eta;
    m.k = constants.k;
    if (dielectric) convertK(object, scene.wavelengthsNm, m);
  } else {
    if (dielectric && !eta && !optional) object.fail("preset", "is missing", "preset or eta");
    if (dielectric && !eta) m.eta = glm::dvec3(1.5);
    if (!dielectric || eta) m.eta = object.numberOrVector("eta", 0, pack::kMaxEta);
    m.k = object.numberOrVector("k", 0, pack::kMaxEta, glm::dvec3(0.0));
  }
  for (int c = 0; c < 3; ++c) {
    if (dielectric && m.k[c] != 0) object.fail("k", "of a dielectric", "0", fmt::format("{}", m.k[c]));
    if (m.eta[c] < pack::kMinEta && (dielectric || m.k[c] < pack::kMinEta))
      object.fail("eta", "is too small", fmt::format("{:g} or more", pack::kMinEta), fmt::format("{}", m.eta[c]));
  }
}

// Returns the index of the image among the scene's textures. texture: bounds and channels of the values.
std::int32_t readMap(StrictObject object, SceneDescription& scene, TextureDescription texture) {
  texture.file = scene.file.parent_path() / object.text("image");
  visitMapKeys(KeyReader(object), texture);
  object.finish();
  const auto found = std::find(scene.textures.begin(), scene.textures.end(), texture);
  const auto index = static_cast<std::int32_t>(found - scene.textures.begin());
  if (found == scene.textures.end()) scene.textures.push_back(std::move(texture));
  if (scene.textures.size() > pack::kMaxTextures)
    object.fail("", "too many images in the materials", fmt::format("at most {}", pack::kMaxTextures));
  return index;
}

void readMaps(StrictObject& object, pack::Material& m, SceneDescription& scene) {
  const bool conductor = pack::isConductor(m.kind);
  TextureDescription albedo, eta, k;
  eta.low = conductor ? 0 : pack::kMinEta;
  k.low = pack::kMinEta;
  eta.high = k.high = pack::kMaxEta;
  eta.grey = !conductor;
  if (pack::canBeDiffuse(m.kind) && object.has("albedoMap"))
    m.maps.albedo = readMap(object.object("albedoMap"), scene, albedo);
  if (pack::canHaveIndexMap(m.kind) && object.has("etaMap")) m.maps.eta = readMap(object.object("etaMap"), scene, eta);
  if (conductor && object.has("kMap")) m.maps.k = readMap(object.object("kMap"), scene, k);
  if (conductor && (m.maps.eta >= 0) != (m.maps.k >= 0))
    object.fail("etaMap", "and kMap belong together", "both or neither", "one");
  if (!m.maps.any()) return;
  StrictObject projection = object.object("projection");
  visitProjectionKeys(KeyReader(projection), m.maps);
  projection.finish();
}

// Required by diffuse surfaces; optional for a metal, and with a map, whose values it multiplies.
void readAlbedo(StrictObject& object, pack::Material& m) {
  if (!pack::canBeDiffuse(m.kind)) return;
  const bool mapped = m.maps.albedo >= 0;
  m.albedo = mapped || pack::isConductor(m.kind) ? object.numberOrVector("albedo", 0, 1, glm::dvec3(mapped ? 1.0 : 0.0))
                                                 : object.numberOrVector("albedo", 0, 1);
}

// Keys that set more than one field, or a field of another name, or exclude each other.
void readSpecialKeys(StrictObject& object, pack::Material& m) {
  if (m.clearCoat.factor > 0 && m.coating.thicknessNm > 0)
    object.fail("clearCoat", "and coating exclude each other", "one of the two");
  if (pack::isEmitter(m.kind) && object.has("polarization")) {
    StrictObject polarization = object.object("polarization");
    m.axis = readDirection(polarization, "axis");
    m.polarization = polarization.number("degree", 0, 1, 1);
    polarization.finish();
  }
  if (m.kind == pack::MaterialKind::wavePlate)
    m.transmittanceParallel = m.transmittanceCrossed = object.numberOrVector("transmittance", 0, 1, glm::dvec3(1.0));
}

}  // namespace

pack::Material readMaterial(const std::string& name, StrictObject object, SceneDescription& scene) {
  pack::Material m;
  m.name = name;
  m.kind = readKind(object);
  if (pack::hasIndex(m.kind)) readIndex(object, m, scene);
  KeyReader keys(object, pack::only(m.kind));
  pack::visitMaterial(keys, m);
  readSpecialKeys(object, m);
  readMaps(object, m, scene);
  readAlbedo(object, m);
  keys.finish();
  object.finish();
  return m;
}

}  // namespace malus::bake
