#include "bake/pack/reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bake/pack/bytes.h"
#include "bake/pack/half.h"
#include "bake/pack/mesh_reader.h"
#include "bake/pack/table.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"

namespace malus::pack {

namespace {

// Largest magnitudes of the schema: beyond them float squares overflow.
constexpr double kMaxLength = 1e15;
constexpr double kMaxLight = 1e15;

void readMeta(ByteReader r, Scene& scene) {
  scene.name = r.text();
  scene.title = r.text();
  scene.origin = r.dvec3Between(-kMaxLength, kMaxLength, "scene origin");
  scene.width = r.u32AtMost(kMaxResolution, "picture width");
  scene.height = r.u32AtMost(kMaxResolution, "picture height");
  scene.depth = r.u32AtMost(kMaxDepth, "depth");
  scene.exposureEv = r.f64Between(-100, 100, "exposure");
  if (scene.width == 0 || scene.height == 0) r.fail("picture without pixels", "a width and height over 0", "0");
  r.end();
}

void readCamera(ByteReader r, Camera& camera) {
  camera.position = r.dvec3Between(-kMaxLength, kMaxLength, "camera position");
  camera.right = r.dvec3Between(-1.001, 1.001, "camera axis");
  camera.up = r.dvec3Between(-1.001, 1.001, "camera axis");
  camera.forward = r.dvec3Between(-1.001, 1.001, "camera axis");
  const auto dot = [](const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const glm::dvec3 axes[3] = {camera.right, camera.up, camera.forward};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
      if (std::abs(dot(axes[i], axes[j]) - (i == j ? 1.0 : 0.0)) > 1e-9)
        r.fail("camera axes are not orthonormal", "unit vectors at right angles", "others");
  const glm::dvec3 handed(camera.right.y * camera.up.z - camera.right.z * camera.up.y,
                          camera.right.z * camera.up.x - camera.right.x * camera.up.z,
                          camera.right.x * camera.up.y - camera.right.y * camera.up.x);
  if (dot(handed, camera.forward) > 0) r.fail("camera axes are left-handed", "right x up against forward", "along it");
  camera.verticalFovDegrees = r.f64Between(1e-3, 179, "field of view");
  camera.mediumEta = r.f64Between(kMinEta, kMaxEta, "index of the camera's medium");
  r.end();
}

void readEnvironment(ByteReader r, Environment& environment) {
  environment.radiance = r.dvec3Between(0, kMaxLight, "environment radiance");
  environment.ambientIrradiance = r.f64Between(0, 1e6, "diffuse fill");
  for (glm::dvec3& c : environment.irradiance) c = r.dvec3Between(-kMaxLight, kMaxLight, "irradiance coefficient");
  environment.size = r.u32AtMost(kMaxEnvironmentSize, "environment size");
  if (environment.size > 0) {
    const std::uint64_t side = environment.size + 2;
    if (r.left() != side * side * 6)
      r.fail("environment texels", fmt::format("{} bytes", side * side * 6), fmt::format("{}", r.left()));
    environment.texels.resize(static_cast<std::size_t>(side * side));
    for (glm::vec3& t : environment.texels)
      for (int i = 0; i < 3; ++i) {
        t[i] = floatFromHalf(r.u16());
        if (!std::isfinite(t[i]) || t[i] < 0)
          r.fail("environment texel", "a finite radiance of 0 or more", fmt::format("{}", t[i]));
      }
  }
  r.end();
}

void readLights(ByteReader r, std::vector<PointLight>& lights) {
  const std::uint32_t count = r.count(48, "number of lights");
  if (count > kMaxLights) r.fail("number of lights", fmt::format("at most {}", kMaxLights), fmt::format("{}", count));
  for (std::uint32_t i = 0; i < count; ++i) {
    PointLight light;
    light.position = r.dvec3Between(-kMaxLength, kMaxLength, "light position");
    light.intensity = r.dvec3Between(0, kMaxLight, "light intensity");
    lights.push_back(light);
  }
  r.end();
}

void readMaterials(ByteReader r, std::vector<Material>& materials) {
  const std::uint32_t count = r.count(124, "number of materials");
  if (count > kMaxMaterials)
    r.fail("number of materials", fmt::format("at most {}", kMaxMaterials), fmt::format("{}", count));
  for (std::uint32_t i = 0; i < count; ++i) {
    Material m;
    m.name = r.text();
    m.kind = static_cast<MaterialKind>(r.u32AtMost(kMaterialKindCount - 1, "kind of material"));
    m.eta = r.dvec3Between(0, kMaxEta, "index eta");
    m.k = r.dvec3Between(0, kMaxEta, "index k");
    for (int c = 0; c < 3; ++c)
      if (m.eta[c] < kMinEta && m.k[c] < kMinEta)
        r.fail("index of refraction", "eta or k of at least 1e-3", "both below");
    if (isDielectric(m.kind))
      for (int c = 0; c < 3; ++c)
        if (m.eta[c] < kMinEta || m.k[c] != 0)
          r.fail("index of a dielectric", "eta of at least 1e-3 and k = 0",
                 fmt::format("eta {}, k {}", m.eta[c], m.k[c]));
    m.outsideEta = r.f64Between(kMinEta, kMaxEta, "outside index");
    m.albedo = r.dvec3Between(0, 1, "albedo");
    m.radiance = r.dvec3Between(0, kMaxLight, "radiance");
    m.highlightStrength = r.f64Between(0, 1e6, "highlight strength");
    m.highlightExponent = r.u32AtMost(4095, "highlight exponent");
    materials.push_back(std::move(m));
  }
  r.end();
}

void requireUnit(const ByteReader& r, const glm::dvec3& v, std::string_view what) {
  if (std::abs(v.x * v.x + v.y * v.y + v.z * v.z - 1) > 1e-9) r.fail(what, "a unit vector", "another");
}

// Textures come first: what a material does with one bounds its values.
void readTextures(ByteReader r, std::vector<Texture>& textures) {
  const std::uint32_t count = r.count(24, "number of textures");
  if (count > kMaxTextures)
    r.fail("number of textures", fmt::format("at most {}", kMaxTextures), fmt::format("{}", count));
  std::uint64_t total = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    Texture t;
    t.name = r.text();
    t.width = r.u32AtMost(kMaxTextureSide, "width of a texture");
    t.height = r.u32AtMost(kMaxTextureSide, "height of a texture");
    const std::uint64_t texels = std::uint64_t{t.width} * t.height;
    total += texels;
    if (total > kMaxTexels) r.fail("texels", fmt::format("at most {} in all", kMaxTexels), "more");
    if (texels == 0 || texels * 12 > r.left())
      r.fail(fmt::format("texels of texture '{}'", t.name), fmt::format("{} bytes, more than 0", texels * 12),
             fmt::format("{} left", r.left()));
    t.texels.resize(static_cast<std::size_t>(texels));
    for (glm::vec3& texel : t.texels)
      for (int c = 0; c < 3; ++c) {
        texel[c] = r.f32();
        if (!(texel[c] >= 0 && texel[c] <= static_cast<float>(kMaxEta)))
          r.fail("texel", fmt::format("0 to {:g}", kMaxEta), fmt::format("{}", texel[c]));
      }
    textures.push_back(std::move(t));
  }
  r.end();
}

void readSky(ByteReader r, Environment& environment) {
  environment.sun = r.dvec3Between(-1.001, 1.001, "direction of the sun");
  requireUnit(r, environment.sun, "direction of the sun");
  environment.skyDegree = r.f64Between(0, 1, "polarization of the sky");
  r.end();
}

// Smallest and largest number of a texture.
struct Range {
  float low = 0, high = 0;
};
std::vector<Range> rangesOf(const std::vector<Texture>& textures) {
  std::vector<Range> ranges;
  for (const Texture& texture : textures) {
    Range range{texture.texels[0].x, texture.texels[0].x};
    for (const glm::vec3& t : texture.texels) {
      range.low = std::min({range.low, t.x, t.y, t.z});
      range.high = std::max({range.high, t.x, t.y, t.z});
    }
    ranges.push_back(range);
  }
  return ranges;
}

std::int32_t readMap(ByteReader& r, const std::vector<Range>& ranges, float low, float high) {
  const std::uint32_t index = r.u32AtMost(static_cast<std::uint32_t>(ranges.size()), "texture of a material");
  if (index > 0 && (ranges[index - 1].low < low || ranges[index - 1].high > high))
    r.fail(fmt::format("texture {} of a material", index), fmt::format("values from {:g} to {:g}", low, high),
           fmt::format("{:g} to {:g}", ranges[index - 1].low, ranges[index - 1].high));
  return static_cast<std::int32_t>(index) - 1;
}

void readSurfaces(ByteReader r, const std::vector<Texture>& textures, std::vector<Material>& materials) {
  const std::uint32_t count = r.count(276, "number of surfaces");
  if (count != materials.size())
    r.fail("number of surfaces", fmt::format("{}, as of materials", materials.size()), fmt::format("{}", count));
  const std::vector<Range> ranges = rangesOf(textures);
  for (Material& m : materials) {
    m.absorption = r.dvec3Between(0, kMaxAbsorption, "absorption");
    m.outsideAbsorption = r.dvec3Between(0, kMaxAbsorption, "absorption outside");
    m.coating.eta = r.dvec3Between(kMinEta, kMaxEta, "index of a coating");
    m.coating.thicknessNm = r.f64Between(0, canBeCoated(m.kind) ? kMaxThicknessNm : 0, "thickness of a coating");
    m.roughness = r.f64Between(0, canBeRough(m.kind) ? 1 : 0, "roughness");
    m.axis = r.dvec3Between(-1.001, 1.001, "axis");
    m.polarization = r.f64Between(0, isEmitter(m.kind) ? 1 : 0, "polarization of an emitter");
    if (isPolarizingElement(m.kind) || m.polarization > 0) requireUnit(r, m.axis, "axis");
    m.transmittanceParallel = r.dvec3Between(0, 1, "transmittance of a sheet");
    m.transmittanceCrossed = r.dvec3Between(0, 1, "transmittance of a sheet");
    m.retardanceDegrees = r.dvec3Between(-kMaxRetardanceDegrees, kMaxRetardanceDegrees, "retardance");
    m.maps.albedo = readMap(r, ranges, 0, 1);
    m.maps.eta = readMap(r, ranges, isConductor(m.kind) ? 0 : static_cast<float>(kMinEta), static_cast<float>(kMaxEta));
    m.maps.k = readMap(r, ranges, static_cast<float>(kMinEta), static_cast<float>(kMaxEta));
    if ((m.maps.eta >= 0 && !canHaveIndexMap(m.kind)) || (m.maps.k >= 0) != (m.maps.eta >= 0 && isConductor(m.kind)))
      r.fail(fmt::format("index map of material '{}'", m.name), "eta of an opaque interface, with k of a metal alone",
             "another");
    m.maps.origin = r.dvec3Between(-kMaxLength, kMaxLength, "origin of a projection");
    m.maps.u = r.dvec3Between(-kMaxLength, kMaxLength, "axis of a projection");
    m.maps.v = r.dvec3Between(-kMaxLength, kMaxLength, "axis of a projection");
  }
  r.end();
}

void readEffects(ByteReader r, std::vector<Effect>& effects) {
  const std::uint32_t count = r.count(12, "number of effects");
  for (std::uint32_t i = 0; i < count; ++i) {
    Effect effect;
    effect.name = r.text();
    effect.on = r.u32AtMost(1, "state of an effect") == 1;
    effect.reason = r.text();
    effects.push_back(std::move(effect));
  }
  r.end();
}

}  // namespace

Pack parse(std::span<const std::byte> bytes, std::string_view where) {
  Pack pack;
  readTable(bytes, where, pack);
  const auto find = [&](const char* id, bool required) { return findSection(pack.sections, id, required, where); };
  const auto body = [&](std::size_t i) {
    return bytes.subspan(static_cast<std::size_t>(pack.sections[i].offset),
                         static_cast<std::size_t>(pack.sections[i].sizeBytes));
  };
  const auto reader = [&](std::size_t i) { return ByteReader(body(i), pack.sections[i].offset, where); };
  readMeta(reader(*find(kMeta, true)), pack.scene);
  readCamera(reader(*find(kCamera, true)), pack.scene.camera);
  readEnvironment(reader(*find(kEnvironment, true)), pack.scene.environment);
  readLights(reader(*find(kLights, true)), pack.scene.lights);
  readMaterials(reader(*find(kMaterials, true)), pack.scene.materials);
  if (const auto at = find(kTextures, false)) readTextures(reader(*at), pack.scene.textures);
  if (const auto at = find(kSurfaces, false)) readSurfaces(reader(*at), pack.scene.textures, pack.scene.materials);
  for (const Material& m : pack.scene.materials)
    if (isPolarizingElement(m.kind) && m.axis == glm::dvec3(0.0))
      throw Error(where, fmt::format("section {} is missing", kSurfaces), fmt::format("the axis of '{}'", m.name));
  if (const auto at = find(kSky, false)) readSky(reader(*at), pack.scene.environment);
  const std::size_t geometry = *find(kGeometry, true);
  readMeshes(reader(*find(kMeshes, true)), body(geometry), pack.sections[geometry].offset, where, pack);
  if (const auto at = find(kEncodings, false)) pack.encodings = readEncodings(reader(*at), pack.scene.meshes.size());
  if (const auto at = find(kSourceMap, false)) readSourceMap(reader(*at), pack.scene.meshes);
  if (const auto at = find(kEffects, false)) readEffects(reader(*at), pack.scene.effects);
  if (const auto at = find(kProvenance, false)) {
    ByteReader r = reader(*at);
    pack.scene.provenance = r.text(1u << 24);
    r.end();
  }
  return pack;
}

Pack read(const std::filesystem::path& path) { return parse(readFile(path), path.string()); }

std::uint64_t canonicalGeometryHash(const Scene& scene) {
  ByteWriter w;
  for (const Mesh& mesh : scene.meshes) {
    w.u32(static_cast<std::uint32_t>(mesh.positions.size()));
    w.u32(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const glm::vec3& p : mesh.positions) w.f32(p.x), w.f32(p.y), w.f32(p.z);
    for (const glm::vec3& n : mesh.normals) w.f32(n.x), w.f32(n.y), w.f32(n.z);
    for (const glm::uvec3& t : mesh.triangles) w.u32(t.x), w.u32(t.y), w.u32(t.z);
  }
  return hashOf(w.take());
}

}  // namespace malus::pack
