#include "bake/pack/writer.h"

#include <xxhash.h>

#include <algorithm>
#include <utility>

#include "bake/pack/bytes.h"
#include "bake/pack/format.h"
#include "bake/pack/half.h"
#include "bake/pack/mesh_writer.h"
#include "bake/pack/reader.h"
#include "meshprep/base/atomic_file.h"

namespace malus::pack {

std::uint64_t hashOf(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

namespace {

struct Body {
  const char* id;
  std::uint32_t flags;
  std::vector<std::byte> bytes;
};

std::vector<std::byte> metaBytes(const Scene& scene) {
  ByteWriter w;
  w.text(scene.name);
  w.text(scene.title);
  w.dvec3(scene.origin);
  w.u32(scene.width);
  w.u32(scene.height);
  w.u32(scene.depth);
  w.f64(scene.exposureEv);
  return w.take();
}

std::vector<std::byte> cameraBytes(const Camera& camera) {
  ByteWriter w;
  w.dvec3(camera.position);
  w.dvec3(camera.right);
  w.dvec3(camera.up);
  w.dvec3(camera.forward);
  w.f64(camera.verticalFovDegrees);
  w.f64(camera.mediumEta);
  return w.take();
}

std::vector<std::byte> environmentBytes(const Environment& environment) {
  ByteWriter w;
  w.dvec3(environment.radiance);
  w.f64(environment.ambientIrradiance);
  for (const glm::dvec3& c : environment.irradiance) w.dvec3(c);
  w.u32(environment.size);
  for (const glm::vec3& t : environment.texels)
    for (int i = 0; i < 3; ++i) w.u16(halfFromFloat(t[i]));
  return w.take();
}

std::vector<std::byte> lightBytes(const std::vector<PointLight>& lights) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(lights.size()));
  for (const PointLight& light : lights) w.dvec3(light.position), w.dvec3(light.intensity);
  return w.take();
}

std::vector<std::byte> materialBytes(const std::vector<Material>& materials) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(materials.size()));
  for (const Material& m : materials) {
    w.text(m.name);
    w.u32(static_cast<std::uint32_t>(m.kind));
    w.dvec3(m.eta);
    w.dvec3(m.k);
    w.f64(m.outsideEta);
    w.dvec3(m.albedo);
    w.dvec3(m.radiance);
    w.f64(m.highlightStrength);
    w.u32(m.highlightExponent);
  }
  return w.take();
}

std::vector<std::byte> surfaceBytes(const std::vector<Material>& materials) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(materials.size()));
  for (const Material& m : materials) {
    w.dvec3(m.absorption);
    w.dvec3(m.outsideAbsorption);
    w.dvec3(m.coating.eta);
    w.f64(m.coating.thicknessNm);
    w.f64(m.roughness);
    w.dvec3(m.axis);
    w.f64(m.polarization);
    w.dvec3(m.transmittanceParallel);
    w.dvec3(m.transmittanceCrossed);
    w.dvec3(m.retardanceDegrees);
    for (const std::int32_t map : {m.maps.albedo, m.maps.eta, m.maps.k}) w.u32(static_cast<std::uint32_t>(map + 1));
    w.dvec3(m.maps.origin);
    w.dvec3(m.maps.u);
    w.dvec3(m.maps.v);
  }
  return w.take();
}

std::vector<std::byte> textureBytes(const std::vector<Texture>& textures) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(textures.size()));
  for (const Texture& t : textures) {
    w.text(t.name);
    w.u32(t.width);
    w.u32(t.height);
    for (const glm::vec3& texel : t.texels) w.f32(texel.x), w.f32(texel.y), w.f32(texel.z);
  }
  return w.take();
}

std::vector<std::byte> skyBytes(const Environment& environment) {
  ByteWriter w;
  w.dvec3(environment.sun);
  w.f64(environment.skyDegree);
  return w.take();
}

std::vector<std::byte> effectBytes(const std::vector<Effect>& effects) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(effects.size()));
  for (const Effect& e : effects) w.text(e.name), w.u32(e.on ? 1 : 0), w.text(e.reason);
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
    table.u32(1);
    table.u32(body.flags);
    table.u32(0);
    table.u64(offset);
    table.u64(body.bytes.size());
    table.u64(hashOf(body.bytes));
    offset += body.bytes.size();
  }
  const std::vector<std::byte> tableBytes = table.take();
  ByteWriter w;
  w.raw(std::as_bytes(std::span(kMagic)));
  w.u32(kFormatVersion);
  w.u32(static_cast<std::uint32_t>(bodies.size()));
  w.u64(offset);
  w.u64(hashOf(tableBytes));
  const std::vector<std::byte> start = w.take();
  ByteWriter file;
  file.raw(start);
  file.u64(hashOf(start));
  file.raw(tableBytes);
  for (const Body& body : bodies) {
    file.padTo(kAlignment);
    file.raw(body.bytes);
  }
  return file.take();
}

}  // namespace

Written serialize(const Scene& scene, const WriteSettings& settings, const OlderPack* older) {
  EncodedMeshes encoded = encodeMeshes(scene, settings, older);
  Written written;
  written.meshes = std::move(encoded.report);
  written.grid = encoded.encodings.grid;
  written.warnings = std::move(encoded.warnings);
  written.whyAll = std::move(encoded.whyAll);
  std::vector<Body> bodies;
  bodies.push_back({kMeta, 0, metaBytes(scene)});
  bodies.push_back({kCamera, 0, cameraBytes(scene.camera)});
  bodies.push_back({kEnvironment, 0, environmentBytes(scene.environment)});
  bodies.push_back({kLights, 0, lightBytes(scene.lights)});
  bodies.push_back({kMaterials, 0, materialBytes(scene.materials)});
  // What few scenes have: without it a pack is what it was before these sections existed.
  if (!std::all_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return m.isPlain(); }))
    bodies.push_back({kSurfaces, 0, surfaceBytes(scene.materials)});
  if (!scene.textures.empty()) bodies.push_back({kTextures, 0, textureBytes(scene.textures)});
  if (scene.environment.hasSun()) bodies.push_back({kSky, 0, skyBytes(scene.environment)});
  bodies.push_back({kMeshes, 0, std::move(encoded.table)});
  bodies.push_back({kGeometry, 0, std::move(encoded.geometry)});
  bodies.push_back({kEncodings, kOptional, encodingBytes(encoded.encodings)});
  if (settings.keepMap) bodies.push_back({kSourceMap, kOptional, std::move(encoded.map)});
  bodies.push_back({kEffects, kOptional, effectBytes(scene.effects)});
  bodies.push_back({kProvenance, kOptional, textBytes(scene.provenance)});
  written.bytes = assemble(bodies);
  return written;
}

Written write(const std::filesystem::path& path, const Scene& scene, const WriteSettings& settings,
              const OlderPack* older) {
  Written written = serialize(scene, settings, older);
  parse(written.bytes, path.string());  // what cannot be read back is not written
  writeFile(path, written.bytes);
  return written;
}

}  // namespace malus::pack
