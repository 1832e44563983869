#include "bake/unpack.h"

#include <bit>
#include <cstring>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "bake/scene_json.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image.h"

namespace malus::bake {
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

static_assert(std::endian::native == std::endian::little, "the PLY files are written as little-endian");

// Polygon File Format, binary little-endian: float x y z (nx ny nz), faces as lists of int.
std::string plyText(const pack::Mesh& mesh) {
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
  image::Image image;
  image.width = image.height = static_cast<int>(environment.size) + 2;
  image.channels = {"R", "G", "B"};
  for (const glm::vec3& t : environment.texels) image.pixels.insert(image.pixels.end(), {t.x, t.y, t.z});
  image::writeExr(file, image);
}

// Linear texels, as the pack has them.
void writeTexture(const pack::Texture& texture, const fs::path& file) {
  image::Image image;
  image.width = static_cast<int>(texture.width);
  image.height = static_cast<int>(texture.height);
  image.channels = {"R", "G", "B"};
  for (const glm::vec3& t : texture.texels) image.pixels.insert(image.pixels.end(), {t.x, t.y, t.z});
  image::writeExr(file, image);
}

}  // namespace

json unpack(const pack::Pack& pack, const fs::path& folder) {
  const pack::Scene& scene = pack.scene;
  std::error_code failed;
  // Overwrite only what unpack wrote: a source scene.json has no packHash.
  if (fs::exists(folder / "scene.json", failed)) {
    const json old = json::parse(readTextFile(folder / "scene.json"), nullptr, false);
    if (!old.is_object() || !old.contains("packHash"))
      throw Error((folder / "scene.json").string(), "exists and was not written by 'malus unpack'",
                  "an empty folder, or one that 'malus unpack' wrote; choose it with --output");
    fs::remove_all(folder / "meshes", failed);
    fs::remove_all(folder / "textures", failed);
    fs::remove(folder / "environment.exr", failed);
  }
  fs::create_directories(folder / "meshes", failed);
  if (failed)
    throw Error(folder.string(), "cannot create the folder", "a writable folder; choose it with --output",
                failed.message());

  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    writeFile(folder / meshFile(i), std::string_view(plyText(scene.meshes[i])));
  if (pack.hasSourceMap())
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
      writeFile(
          folder / mapFile(i),
          json{{"vertices", scene.meshes[i].sourceVertices}, {"triangles", scene.meshes[i].sourceFaces}}.dump() + "\n");
  if (!scene.textures.empty()) fs::create_directories(folder / "textures", failed);
  for (std::size_t i = 0; i < scene.textures.size(); ++i) writeTexture(scene.textures[i], folder / textureFile(i));
  if (scene.environment.size > 0) writeEnvironment(scene.environment, folder / kEnvironmentFile);
  json document = sceneJson(pack);
  writeFile(folder / "scene.json", document.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
  return document;
}

}  // namespace malus::bake
