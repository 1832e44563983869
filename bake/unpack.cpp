#include "bake/unpack.h"

#include <bit>
#include <cstring>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "bake/image/image.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"

namespace malus::bake {
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

static_assert(std::endian::native == std::endian::little, "the PLY files are written as little-endian");

json vectorJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Polygon File Format, binary little-endian: float x y z (nx ny nz), faces as lists of int.
std::string plyOf(const pack::Mesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
      mesh.positions.size());
  if (!mesh.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  text += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
  const auto append = [&](const auto& value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    text.append(bytes, sizeof value);
  };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    append(mesh.positions[i]);
    if (!mesh.normals.empty()) append(mesh.normals[i]);
  }
  for (const glm::uvec3& triangle : mesh.triangles) {
    append(std::uint8_t{3});
    append(triangle);
  }
  return text;
}

void writeEnvironment(const pack::Environment& environment, const fs::path& file) {
  image::Image picture;
  picture.width = picture.height = static_cast<int>(environment.size) + 2;
  picture.channels = {"R", "G", "B"};
  for (const glm::vec3& t : environment.texels) picture.pixels.insert(picture.pixels.end(), {t.x, t.y, t.z});
  image::writeExr(file, picture);
}

json materialJson(const pack::Material& m) {
  json highlight;
  if (m.highlightStrength > 0) highlight = {{"strength", m.highlightStrength}, {"exponent", m.highlightExponent}};
  json result = {{"name", m.name},
                 {"type", pack::nameOf(m.kind)},
                 {"eta", vectorJson(m.eta)},
                 {"k", vectorJson(m.k)},
                 {"outsideEta", m.outsideEta},
                 {"albedo", vectorJson(m.albedo)},
                 {"radiance", vectorJson(m.radiance)},
                 {"highlight", highlight}};
  if (m.isPlain()) return result;
  const auto map = [](std::int32_t index) { return index < 0 ? json() : json(index); };
  result["absorption"] = vectorJson(m.absorption);
  result["outsideAbsorption"] = vectorJson(m.outsideAbsorption);
  result["coating"] = {{"eta", vectorJson(m.coating.eta)}, {"thicknessNm", m.coating.thicknessNm}};
  result["roughness"] = m.roughness;
  result["axis"] = vectorJson(m.axis);
  result["polarization"] = m.polarization;
  result["along"] = vectorJson(m.along);
  result["across"] = vectorJson(m.across);
  result["retardanceDegrees"] = vectorJson(m.retardanceDegrees);
  result["maps"] = {{"albedo", map(m.maps.albedo)},        {"eta", map(m.maps.eta)},    {"k", map(m.maps.k)},
                    {"origin", vectorJson(m.maps.origin)}, {"u", vectorJson(m.maps.u)}, {"v", vectorJson(m.maps.v)}};
  return result;
}

// Linear texels, as the pack has them.
void writeTexture(const pack::Texture& texture, const fs::path& file) {
  image::Image picture;
  picture.width = static_cast<int>(texture.width);
  picture.height = static_cast<int>(texture.height);
  picture.channels = {"R", "G", "B"};
  for (const glm::vec3& t : texture.texels) picture.pixels.insert(picture.pixels.end(), {t.x, t.y, t.z});
  image::writeExr(file, picture);
}

}  // namespace

json unpack(const pack::Pack& pack, const fs::path& folder) {
  const pack::Scene& scene = pack.scene;
  std::error_code failed;
  // Somebody's scene, which looks alike, is not written over.
  if (fs::exists(folder / "scene.json", failed)) {
    const json old = json::parse(readTextFile(folder / "scene.json"), nullptr, false);
    if (!old.is_object() || !old.contains("packHash"))
      throw Error((folder / "scene.json").string(), "is there and was not unpacked from a pack", "another folder");
    fs::remove_all(folder / "meshes", failed);
    fs::remove_all(folder / "textures", failed);
    fs::remove(folder / "environment.exr", failed);
  }
  fs::create_directories(folder / "meshes", failed);
  if (failed) throw Error(folder.string(), "cannot make the folder", "", failed.message());

  json meshes = json::array(), materials = json::array(), lights = json::array();
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const pack::Mesh& mesh = scene.meshes[i];
    const std::string file = fmt::format("meshes/{:03}.ply", i);
    writeFile(folder / file, std::string_view(plyOf(mesh)));
    meshes.push_back({{"name", mesh.name},
                      {"file", file},
                      {"material", scene.materials[mesh.material].name},
                      {"sheet", mesh.sheet},
                      {"vertices", mesh.positions.size()},
                      {"triangles", mesh.triangles.size()}});
  }
  for (const pack::Material& m : scene.materials) materials.push_back(materialJson(m));
  for (const pack::PointLight& light : scene.lights)
    lights.push_back(
        {{"type", "point"}, {"position", vectorJson(light.position)}, {"intensity", vectorJson(light.intensity)}});

  json textures = json::array();
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const std::string file = fmt::format("textures/{:03}.exr", i);
    fs::create_directories(folder / "textures", failed);
    writeTexture(scene.textures[i], folder / file);
    textures.push_back({{"name", scene.textures[i].name}, {"file", file}});
  }

  const pack::Environment& e = scene.environment;
  json environment = {{"diffuseFill", e.diffuseFill}, {"irradiance", json::array()}};
  for (const glm::dvec3& c : e.irradiance) environment["irradiance"].push_back(vectorJson(c));
  if (e.skyDegree > 0) environment["sky"] = {{"sun", vectorJson(e.sun)}, {"maxDegree", e.skyDegree}};
  if (e.size == 0) {
    environment["radiance"] = vectorJson(e.radiance);
  } else {
    environment["image"] = "environment.exr";
    environment["size"] = e.size;
    writeEnvironment(e, folder / "environment.exr");
  }

  const pack::Camera& c = scene.camera;
  json document = {{"name", scene.name},
                   {"title", scene.title},
                   {"packHash", fmt::format("{:016x}", pack.hash)},
                   {"origin", vectorJson(scene.origin)},
                   {"resolution", {scene.width, scene.height}},
                   {"depth", scene.depth},
                   {"exposureEv", scene.exposureEv},
                   {"camera",
                    {{"position", vectorJson(c.position)},
                     {"right", vectorJson(c.right)},
                     {"up", vectorJson(c.up)},
                     {"forward", vectorJson(c.forward)},
                     {"verticalFovDegrees", c.verticalFovDegrees},
                     {"mediumEta", c.mediumEta}}},
                   {"environment", environment},
                   {"lights", lights},
                   {"materials", materials},
                   {"textures", textures},
                   {"meshes", meshes}};
  writeFile(folder / "scene.json", document.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
  return document;
}

}  // namespace malus::bake
