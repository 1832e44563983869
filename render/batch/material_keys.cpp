#include "render/batch/material_keys.h"

#include <map>
#include <string>
#include <type_traits>

#include <fmt/format.h>

#include "bake/materials/dielectric_k.h"
#include "bake/materials/presets.h"
#include "bake/pack/material_fields.h"
#include "meshprep/base/error.h"

namespace malus::render {
using bake::StrictObject;

namespace {

// Sets the fields of a material that have a key of a number, a vector or a truth value, by their rows
// (bake/pack/material_fields.h). Unlike bake::KeyReader it keeps the value of an absent key.
class FieldReader {
 public:
  FieldReader(StrictObject& object, pack::MaterialKind kind) : object_(object), kind_(pack::only(kind)) {}

  template <class T>
  void operator()(const pack::Field& field, T& value) {
    constexpr bool kIsReadable = std::is_same_v<T, double> || std::is_same_v<T, glm::dvec3> ||
                                 std::is_same_v<T, std::uint32_t> || std::is_same_v<T, bool>;
    if constexpr (kIsReadable) {
      if (field.key == pack::Key::none || (field.kinds & kind_) == 0 || field.shape == pack::Shape::direction) return;
      const auto dot = field.name.find('.');
      if (dot == std::string_view::npos) {
        read(object_, std::string(field.name), field, value);
        return;
      }
      const std::string outer(field.name.substr(0, dot));
      if (!object_.has(outer.c_str())) return;
      const auto nested = nested_.try_emplace(outer, object_.object(outer.c_str())).first;
      read(nested->second, std::string(field.name.substr(dot + 1)), field, value);
    }
  }

  void finish() {
    for (auto& [key, object] : nested_) object.finish();
  }

 private:
  template <class T>
  static void read(StrictObject& object, const std::string& key, const pack::Field& field, T& value) {
    if (!object.has(key.c_str())) return;
    const double low = field.lowInScene(), high = field.highInScene();
    if constexpr (std::is_same_v<T, bool>)
      value = object.flag(key.c_str(), value);
    else if constexpr (std::is_same_v<T, double>)
      value = object.number(key.c_str(), low, high);
    else if constexpr (std::is_same_v<T, std::uint32_t>)
      value = object.integer(key.c_str(), static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high));
    else
      value = object.numberOrVector(key.c_str(), low, high);
  }

  StrictObject& object_;
  pack::KindSet kind_;
  std::map<std::string, StrictObject> nested_;
};

void setPreset(StrictObject& object, const glm::dvec3& wavelengthsNm, pack::Material& m) {
  if (object.has("eta") || object.has("k")) object.fail("preset", "and eta, k exclude each other", "one of the two");
  try {
    const bake::OpticalConstants constants = bake::requirePreset(object.text("preset")).at(wavelengthsNm);
    m.eta = constants.eta;
    m.k = constants.k;
    if (pack::isDielectric(m.kind)) bake::convertDielectricK(wavelengthsNm, m);
  } catch (const Error& error) {
    object.fail("preset", error.what(), "");
  }
}

// The index eta - i k.
void readIndex(StrictObject& object, const glm::dvec3& wavelengthsNm, pack::Material& m) {
  if (!pack::hasIndex(m.kind)) return;
  if (object.has("preset")) {
    setPreset(object, wavelengthsNm, m);
    return;
  }
  m.eta = object.numberOrVector("eta", 0, pack::kMaxEta, m.eta);
  if (pack::isConductor(m.kind)) m.k = object.numberOrVector("k", 0, pack::kMaxEta, m.k);
  for (int c = 0; c < 3; ++c)
    if (m.eta[c] < pack::kMinEta && (pack::isDielectric(m.kind) || m.k[c] < pack::kMinEta))
      object.fail("eta", "is too small", fmt::format("{:g} or more", pack::kMinEta), fmt::format("{}", m.eta[c]));
}

// Throws Error if a texture replaces a constant that the object states.
void refuseMapped(StrictObject& object, const pack::Material& m) {
  const auto refuse = [&](const char* key, bool isMapped) {
    if (isMapped && object.has(key))
      object.fail(key, fmt::format("material '{}' has a texture in its place", m.name),
                  "a material without this texture");
  };
  const pack::MeshMaps& maps = m.meshMaps;
  for (const char* key : {"eta", "k", "preset"})
    if (pack::hasIndex(m.kind))
      refuse(key, m.maps.eta >= 0 || maps.eta.isUsed() || maps.k.isUsed() || maps.reflectance.isUsed());
  refuse("albedo", pack::canBeDiffuse(m.kind) && maps.albedo.isUsed());
  refuse("roughness", pack::canBeRough(m.kind) && maps.roughness.isUsed());
  refuse("radiance", pack::isEmitter(m.kind) && maps.radiance.isUsed());
  refuse("transmittance", pack::transmits(m.kind) && maps.transmittance.isUsed());
}

// Throws Error for keys of scene.json that depend on files, on the geometry or on the kind.
void refuseBakedKeys(StrictObject& object) {
  for (const char* key : {"type", "axis", "albedoMap", "etaMap", "kMap", "projection"})
    if (object.has(key)) object.fail(key, "cannot change after the bake", "a pack that is baked with it");
}

// Rules over several fields, as of bake/scene_file/material.cpp.
void checkLayers(StrictObject& object, const pack::Material& before, const pack::Material& m) {
  if (m.clearCoat.factor > 0 && m.coating.thicknessNm > 0)
    object.fail("clearCoat", "and coating exclude each other", "a thickness or a factor of 0");
  if (m.coating.thicknessNm > 0 && before.coating.thicknessNm == 0 && !object.object("coating").has("eta"))
    object.fail("coating.eta", "is missing", "the index of the film, which the pack does not have");
  if (m.highlightStrength > 0 && m.highlightExponent == 0)
    object.fail("highlight.exponent", "is missing", "1 to 4095, because the pack has no highlight");
}

}  // namespace

void overrideMaterial(StrictObject& object, const glm::dvec3& wavelengthsNm, pack::Material& m) {
  const pack::Material before = m;
  refuseBakedKeys(object);
  refuseMapped(object, m);
  readIndex(object, wavelengthsNm, m);
  FieldReader fields(object, m.kind);
  pack::visitMaterial(fields, m);
  fields.finish();
  if (pack::canBeDiffuse(m.kind)) m.albedo = object.numberOrVector("albedo", 0, 1, m.albedo);
  if (m.kind == pack::MaterialKind::wavePlate && object.has("transmittance"))
    m.transmittanceParallel = m.transmittanceCrossed = object.numberOrVector("transmittance", 0, 1);
  if (pack::isEmitter(m.kind) && m.axis != glm::dvec3(0.0) && object.has("polarization")) {
    StrictObject polarization = object.object("polarization");
    m.polarization = polarization.number("degree", 0, 1);
    polarization.finish();
  }
  checkLayers(object, before, m);
  object.finish();
}

}  // namespace malus::render
