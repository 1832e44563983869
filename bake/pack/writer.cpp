#include "bake/pack/writer.h"

#include <xxhash.h>

#include <utility>

#include "bake/pack/bytes.h"
#include "bake/pack/encodings_section.h"
#include "bake/pack/field_io.h"
#include "bake/pack/format.h"
#include "bake/pack/half.h"
#include "bake/pack/material_fields.h"
#include "bake/pack/mesh_maps.h"
#include "bake/pack/mesh_writer.h"
#include "bake/pack/reader.h"
#include "bake/pack/record_fields.h"
#include "bake/pack/texture_coordinates.h"
#include "bake/pack/texture_section.h"
#include "meshprep/base/atomic_file.h"

namespace malus::pack {

std::uint64_t hashBytes(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

namespace {

struct Body {
  const char* id;
  std::vector<std::byte> bytes;
  std::uint32_t version = 1;
};

std::vector<std::byte> metaBytes(const Scene& scene) {
  ByteWriter w;
  visitMeta(FieldWriter(w), scene);
  return w.take();
}

std::vector<std::byte> cameraBytes(const Camera& camera) {
  ByteWriter w;
  visitCamera(FieldWriter(w, {nullptr, cameraVersion(camera)}), camera);
  return w.take();
}

// Version 1 has halves without a scale only, version 2 no sampled environment.
std::uint32_t environmentVersion(const Environment& environment) {
  if (environment.illuminates) return 3;
  return environment.storage.isPlain() ? 1 : 2;
}

std::vector<std::byte> environmentBytes(const Environment& environment) {
  ByteWriter w;
  visitEnvironment(FieldWriter(w, {nullptr, environmentVersion(environment)}), environment);
  const TexelStorage& storage = environment.storage;
  for (const glm::vec3& t : environment.texels)
    for (int i = 0; i < 3; ++i) {
      if (storage.isFloat)
        w.f32(t[i]);
      else
        w.u16(halfFromFloat(static_cast<float>(t[i] / storage.scale)));
    }
  return w.take();
}

std::vector<std::byte> skyBytes(const Environment& environment) {
  ByteWriter w;
  visitSky(FieldWriter(w), environment);
  return w.take();
}

std::vector<std::byte> wavelengthBytes(const Scene& scene) {
  ByteWriter w;
  visitWavelengths(FieldWriter(w), scene);
  return w.take();
}

std::vector<std::byte> lightBytes(const std::vector<LightSource>& lights) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(lights.size()));
  for (const LightSource& light : lights) visitLight(FieldWriter(w, {nullptr, lightsVersion(lights)}), light);
  return w.take();
}

// MATL, or SRFX of a version.
std::vector<std::byte> materialBytes(const std::vector<Material>& materials, const FieldFilter& filter) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(materials.size()));
  for (const Material& m : materials) visitMaterial(FieldWriter(w, filter), m);
  return w.take();
}

std::vector<std::byte> textureBytes(const Scene& scene) {
  ByteWriter w;
  writeTextures(w, texturesVersion(scene.materials), scene.textures);
  return w.take();
}

std::vector<std::byte> meshMapBytes(const std::vector<Material>& materials) {
  ByteWriter w;
  writeMeshMaps(w, materials);
  return w.take();
}

std::vector<std::byte> instanceBytes(const std::vector<Instance>& instances) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(instances.size()));
  for (const Instance& instance : instances) visitInstance(FieldWriter(w), instance);
  return w.take();
}

std::vector<std::byte> effectBytes(const std::vector<Effect>& effects) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(effects.size()));
  for (const Effect& e : effects) visitEffect(FieldWriter(w), e);
  return w.take();
}

std::vector<std::byte> lightBeyondBytes(const std::vector<double>& shares) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(shares.size()));
  for (const double share : shares) w.f64(share);
  return w.take();
}

std::vector<std::byte> textBytes(const std::string& text) {
  ByteWriter w;
  w.text(text);
  return w.take();
}

std::vector<std::byte> assemble(const std::vector<Body>& bodies) {
  // Offsets first: header, table, then each section on its boundary.
  std::uint64_t offset = kHeaderBytes + bodies.size() * kEntryBytes;
  ByteWriter table;
  for (const Body& body : bodies) {
    offset = (offset + kAlignment - 1) / kAlignment * kAlignment;
    table.raw(std::as_bytes(std::span(body.id, 4)));
    table.u32(body.version);
    table.u32(findSectionInfo(body.id)->flags);
    table.u32(0);
    table.u64(offset);
    table.u64(body.bytes.size());
    table.u64(hashBytes(body.bytes));
    offset += body.bytes.size();
  }
  const std::vector<std::byte> tableBytes = table.take();
  ByteWriter w;
  w.raw(std::as_bytes(std::span(kMagic)));
  w.u32(kFormatVersion);
  w.u32(static_cast<std::uint32_t>(bodies.size()));
  w.u64(offset);
  w.u64(hashBytes(tableBytes));
  const std::vector<std::byte> start = w.take();
  ByteWriter file;
  file.raw(start);
  file.u64(hashBytes(start));
  file.raw(tableBytes);
  for (const Body& body : bodies) {
    file.padTo(kAlignment);
    file.raw(body.bytes);
  }
  return file.take();
}

}  // namespace

Written serialize(const Scene& scene, const WriteSettings& settings, const PreviousPack* previous) {
  EncodedMeshes encoded = encodeMeshes(scene, settings, previous);
  Written written;
  written.meshes = std::move(encoded.report);
  written.positionBits = static_cast<int>(encoded.encodings.positionBits());
  written.warnings = std::move(encoded.warnings);
  written.fullRebakeReason = std::move(encoded.fullRebakeReason);
  std::vector<Body> bodies;
  bodies.push_back({kMeta, metaBytes(scene)});
  bodies.push_back({kCamera, cameraBytes(scene.camera), cameraVersion(scene.camera)});
  bodies.push_back({kEnvironment, environmentBytes(scene.environment), environmentVersion(scene.environment)});
  bodies.push_back({kLights, lightBytes(scene.lights), lightsVersion(scene.lights)});
  bodies.push_back({kMaterials, materialBytes(scene.materials, {kMaterials})});
  // Written only if needed, in the lowest version that suffices: a pack that needs none of it keeps the bytes that it
  // had before these sections and versions existed.
  if (const std::uint32_t version = surfaceVersion(scene.materials); version > 0)
    bodies.push_back({kSurfaces, materialBytes(scene.materials, {kSurfaces, version}), version});
  if (!scene.textures.empty()) bodies.push_back({kTextures, textureBytes(scene), texturesVersion(scene.materials)});
  if (hasMeshMaps(scene.materials)) bodies.push_back({kMeshMaps, meshMapBytes(scene.materials)});
  if (scene.environment.hasSun()) bodies.push_back({kSky, skyBytes(scene.environment)});
  if (scene.wavelengthsNm != kDefaultWavelengthsNm) bodies.push_back({kWavelengths, wavelengthBytes(scene)});
  bodies.push_back({kMeshes, std::move(encoded.table), kNewestMeshes});
  bodies.push_back({kGeometry, std::move(encoded.geometry)});
  if (std::vector<std::byte> bytes = textureBytes(encoded.textures); !bytes.empty())
    bodies.push_back({kTextureCoordinates, std::move(bytes)});
  if (!scene.instances.empty()) bodies.push_back({kInstances, instanceBytes(scene.instances)});
  bodies.push_back({kEncodings, encodingBytes(encoded.encodings), kNewestEncodings});
  if (settings.keepMap) bodies.push_back({kSourceMap, std::move(encoded.map)});
  bodies.push_back({kEffects, effectBytes(scene.effects)});
  if (!scene.lightBeyond.empty()) bodies.push_back({kBeyond, lightBeyondBytes(scene.lightBeyond)});
  bodies.push_back(
      {kProvenance, textBytes(settings.provenance ? settings.provenance(written.warnings) : scene.provenance)});
  written.bytes = assemble(bodies);
  return written;
}

Written write(const std::filesystem::path& path, const Scene& scene, const WriteSettings& settings,
              const PreviousPack* previous) {
  Written written = serialize(scene, settings, previous);
  parse(written.bytes, path.string());  // a pack that cannot be read back is not written
  writeFile(path, written.bytes);
  return written;
}

}  // namespace malus::pack
