#include "bake/pack/reader.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/pack/bytes.h"
#include "bake/pack/encodings_section.h"
#include "bake/pack/field_io.h"
#include "bake/pack/half.h"
#include "bake/pack/instances.h"
#include "bake/pack/material_reader.h"
#include "bake/pack/mesh_maps.h"
#include "bake/pack/mesh_reader.h"
#include "bake/pack/record_fields.h"
#include "bake/pack/table.h"
#include "bake/pack/texture_coordinates.h"
#include "bake/pack/texture_section.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"

namespace malus::pack {

namespace {

void readMeta(ByteReader r, Scene& scene) {
  visitMeta(FieldReader(r), scene);
  r.end();
}

void readCamera(ByteReader r, std::uint32_t version, Camera& camera) {
  visitCamera(FieldReader(r, {nullptr, version}), camera);
  const glm::dvec3 axes[3] = {camera.right, camera.up, camera.forward};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
      if (std::abs(glm::dot(axes[i], axes[j]) - (i == j ? 1.0 : 0.0)) > 1e-9)
        r.fail("camera axes are not orthonormal", "unit vectors at right angles",
               fmt::format("a dot product of {:g}", glm::dot(axes[i], axes[j])));
  if (glm::dot(glm::cross(camera.right, camera.up), camera.forward) > 0)
    r.fail("camera axes are left-handed", "right x up = -forward", "right x up = forward");
  r.end();
}

void readEnvironment(ByteReader r, std::uint32_t version, Environment& environment) {
  visitEnvironment(FieldReader(r, {nullptr, version}), environment);
  const TexelStorage& storage = environment.storage;
  int exponent = 0;
  if (std::frexp(storage.scale, &exponent) != 0.5 || (storage.isFloat && storage.scale != 1))
    r.fail("texelScale", "a power of two; 1 with floats", fmt::format("{:g}", storage.scale));
  if (environment.size > 0) {
    const std::uint64_t side = environment.size + 2, expected = side * side * (storage.isFloat ? 12 : 6);
    if (r.left() != expected)
      r.fail("environment texels", fmt::format("{} bytes", expected), fmt::format("{}", r.left()));
    environment.texels.resize(static_cast<std::size_t>(side * side));
    for (glm::vec3& t : environment.texels)
      for (int i = 0; i < 3; ++i) {
        t[i] = storage.isFloat ? r.f32() : static_cast<float>(floatFromHalf(r.u16()) * storage.scale);
        // Halves err by up to 2^-11 of the value.
        if (!(t[i] >= 0 && t[i] <= static_cast<float>(kMaxLight * (1 + 0x1p-11))))
          r.fail("environment texel is out of range", fmt::format("a radiance of 0 to {:g}", kMaxLight),
                 fmt::format("{}", t[i]));
      }
  }
  r.end();
}

void readSky(ByteReader r, Environment& environment) {
  visitSky(FieldReader(r), environment);
  r.requireUnit(environment.sun, "sky.sun");
  r.end();
}

void readWavelengths(ByteReader r, Scene& scene) {
  visitWavelengths(FieldReader(r), scene);
  r.end();
}

void readLights(ByteReader r, std::uint32_t version, std::vector<LightSource>& lights) {
  const FieldFilter filter{nullptr, version};
  FieldSizes sizes(filter);
  const LightSource any{};
  visitLight(sizes, any);
  lights.resize(r.count(sizes.bytes(), kMaxLights, "number of lights"));
  for (LightSource& light : lights) {
    visitLight(FieldReader(r, filter), light);
    if (light.kind != LightKind::point) r.requireUnit(light.direction, "direction of a light");
    if (light.kind == LightKind::spot && !(light.innerConeDegrees < light.outerConeDegrees))
      r.fail("innerConeDegrees", fmt::format("below outerConeDegrees, {:g}", light.outerConeDegrees),
             fmt::format("{:g}", light.innerConeDegrees));
  }
  r.end();
}

void readInstances(ByteReader r, const std::vector<Mesh>& meshes, std::vector<Instance>& instances) {
  FieldSizes sizes;
  const Instance any{};
  visitInstance(sizes, any);
  instances.resize(r.count(sizes.bytes(), kMaxInstances, "number of instances"));
  std::vector<Box> boxes(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) boxes[i] = findBox(meshes[i].positions);
  for (Instance& instance : instances) {
    visitInstance(FieldReader(r), instance);
    if (instance.mesh >= meshes.size())
      r.fail(fmt::format("mesh of instance '{}' is out of range", instance.name),
             fmt::format("an index below {}", meshes.size()), fmt::format("{}", instance.mesh));
    const Stretch stretch = measureStretch(instance.linear);
    if (!(stretch.condition() <= kMaxInstanceCondition * (1 + 1e-6)))
      r.fail(fmt::format("linear part of instance '{}'", instance.name),
             fmt::format("lengths scaled by factors within 1:{:g}", kMaxInstanceCondition),
             fmt::format("{:g} to {:g}", stretch.smallest, stretch.largest));
    const Box box = placedBox(boxes[instance.mesh], instance);
    const double farthest = farthestCoordinate(box);
    if (!(farthest <= kMaxCoordinate))
      r.fail(fmt::format("place of instance '{}'", instance.name),
             fmt::format("coordinates within {:g} m of the scene's origin", kMaxCoordinate),
             fmt::format("{:g} m", farthest));
  }
  r.end();
}

void readEffects(ByteReader r, std::vector<Effect>& effects) {
  FieldSizes sizes;
  const Effect any{};
  visitEffect(sizes, any);
  effects.resize(r.count(sizes.bytes(), kMaxEffects, "number of effects"));
  for (Effect& effect : effects) visitEffect(FieldReader(r), effect);
  r.end();
}

void readLightBeyond(ByteReader r, std::vector<double>& shares) {
  const std::uint32_t count = r.count(8, kMaxDepth + 1, "number of depths");
  for (std::uint32_t i = 0; i < count; ++i) {
    const double share = r.f64("share"), most = shares.empty() ? 1 : shares.back();
    if (!(share >= 0 && share <= most))
      r.fail("share of the light is out of range", fmt::format("0 to {:g}, that of the depth before", most),
             fmt::format("{:g}", share));
    shares.push_back(share);
  }
  r.end();
}

}  // namespace

Pack parse(std::span<const std::byte> bytes, std::string_view where) {
  Pack pack;
  Scene& scene = pack.scene;
  readTable(bytes, where, pack);
  const auto find = [&](const char* id) { return findSection(pack.sections, id, where); };
  const auto body = [&](const Section& section) {
    return bytes.subspan(static_cast<std::size_t>(section.offset), static_cast<std::size_t>(section.sizeBytes));
  };
  const auto reader = [&](const Section& section) {
    return ByteReader(body(section), section.offset, fmt::format("{}, section {}", where, section.id));
  };
  readMeta(reader(*find(kMeta)), scene);
  const Section& camera = *find(kCamera);
  readCamera(reader(camera), camera.version, scene.camera);
  const Section& environment = *find(kEnvironment);
  readEnvironment(reader(environment), environment.version, scene.environment);
  const Section& lights = *find(kLights);
  readLights(reader(lights), lights.version, scene.lights);
  readMaterials(reader(*find(kMaterials)), scene.materials);
  // Textures come before the surfaces, which bound their values.
  if (const Section* at = find(kTextures)) readTextures(reader(*at), at->version, scene.textures);
  if (const Section* at = find(kSurfaces)) readSurfaces(reader(*at), at->version, scene.textures, scene.materials);
  if (const Section* at = find(kMeshMaps)) readMeshMaps(reader(*at), scene.textures, scene.materials);
  for (const Material& m : scene.materials)
    if (isPolarizingElement(m.kind) && m.axis == glm::dvec3(0.0))
      throw Error(where, fmt::format("section {} is missing", kSurfaces), fmt::format("the axis of '{}'", m.name));
  if (const Section* at = find(kSky)) readSky(reader(*at), scene.environment);
  if (const Section* at = find(kWavelengths)) readWavelengths(reader(*at), scene);
  const Section& geometry = *find(kGeometry);
  const Section& meshes = *find(kMeshes);
  if (const Section* at = find(kTextureCoordinates))
    pack.textures = readTextureEncodings(reader(*at), fmt::format("{}, section {}", where, at->id));
  readMeshes(reader(meshes), meshes.version, body(geometry), geometry.offset, where, pack);
  if (const Section* at = find(kInstances)) readInstances(reader(*at), scene.meshes, scene.instances);
  if (const Section* at = find(kEncodings))
    pack.encodings = readEncodings(reader(*at), at->version, scene.meshes.size());
  if (const Section* at = find(kSourceMap)) readSourceMap(reader(*at), scene.meshes);
  if (const Section* at = find(kEffects)) readEffects(reader(*at), scene.effects);
  if (const Section* at = find(kBeyond)) readLightBeyond(reader(*at), scene.lightBeyond);
  if (const Section* at = find(kProvenance)) {
    ByteReader r = reader(*at);
    scene.provenance = r.text(kMaxProvenanceBytes);
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
    if (mesh.origin != glm::dvec3(0.0)) w.dvec3(mesh.origin);
    for (const glm::dvec3& p : mesh.positions)
      for (int axis = 0; axis < 3; ++axis) w.f32(static_cast<float>(p[axis] - mesh.origin[axis]));
    for (const glm::vec3& n : mesh.normals) w.f32(n.x), w.f32(n.y), w.f32(n.z);
    for (const glm::uvec3& t : mesh.triangles) w.u32(t.x), w.u32(t.y), w.u32(t.z);
    for (const std::vector<glm::vec2>& set : mesh.textureCoordinates)
      for (const glm::vec2& uv : set) w.f32(uv.x), w.f32(uv.y);
    for (const glm::vec4& t : mesh.tangents) w.f32(t.x), w.f32(t.y), w.f32(t.z), w.f32(t.w);
  }
  for (const Instance& instance : scene.instances) {
    w.u32(instance.mesh);
    for (int column = 0; column < 3; ++column) w.dvec3(instance.linear[column]);
    w.dvec3(instance.translation);
  }
  return hashBytes(w.take());
}

}  // namespace malus::pack
