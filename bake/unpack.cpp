#include "bake/unpack.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "bake/scene_json.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image.h"
#include "meshprep/compress/grid_rounding.h"
#include "meshprep/json_text.h"

namespace malus::bake {
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

static_assert(std::endian::native == std::endian::little, "the PLY files are written as little-endian");

// Polygon File Format, binary little-endian: x y z (float if no digit is lost, else double), float nx ny nz, s t and s1
// t1 (sets of texture coordinates), tx ty tz tw (tangent and sign of the bitangent), faces as lists of int.
std::string plyText(const pack::Mesh& mesh) {
  const bool floats = std::all_of(mesh.positions.begin(), mesh.positions.end(),
                                  [](const glm::dvec3& p) { return compress::isFloat(p); });
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {0}\nproperty {1} x\nproperty {1} y\nproperty {1} z\n",
      mesh.positions.size(), floats ? "float" : "double");
  if (!mesh.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  for (std::size_t set = 0; set < mesh.textureCoordinates.size(); ++set)
    if (!mesh.textureCoordinates[set].empty())
      text += fmt::format("property float s{0}\nproperty float t{0}\n", set == 0 ? "" : "1");
  if (!mesh.tangents.empty()) text += "property float tx\nproperty float ty\nproperty float tz\nproperty float tw\n";
  text += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
  const auto append = [&](const auto& value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    text.append(bytes, sizeof value);
  };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (floats)
      append(glm::vec3(mesh.positions[i]));
    else
      append(mesh.positions[i]);
    if (!mesh.normals.empty()) append(mesh.normals[i]);
    for (const std::vector<glm::vec2>& set : mesh.textureCoordinates)
      if (!set.empty()) append(set[i]);
    if (!mesh.tangents.empty()) append(mesh.tangents[i]);
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

// Removes the files that an earlier unpack() wrote; a source scene.json has no packHash. Throws Error if files of
// another origin would be overwritten.
void removeEarlier(const pack::Pack& pack, const fs::path& folder) {
  std::error_code failed;
  const fs::path list = folder / "scene.json";
  const json old = fs::exists(list, failed) ? json::parse(readTextFile(list), nullptr, false) : json();
  if (!old.is_object() || !old.contains("packHash")) {
    for (const fs::path& file : unpackedFiles(pack, folder))
      if (fs::exists(file, failed))
        throw Error(file.string(), "exists and was not written by 'malus unpack'",
                    "an empty folder, or one that 'malus unpack' wrote; choose it with --output");
    return;
  }
  // The names are tested against its own pattern: the document may have been edited.
  const std::regex own("(meshes|textures)/[0-9]{3,9}\\.(ply|map\\.json|exr)");
  for (const char* kind : {"meshes", "textures"})
    for (const json& entry : old.value(kind, json::array()))
      for (const char* key : {"file", "map"})
        if (entry.is_object() && entry.contains(key) && entry[key].is_string() &&
            std::regex_match(entry[key].get<std::string>(), own))
          fs::remove(folder / entry[key].get<std::string>(), failed);
  fs::remove(folder / kEnvironmentFile, failed);
}

}  // namespace

std::vector<fs::path> unpackedFiles(const pack::Pack& pack, const fs::path& folder) {
  std::vector<fs::path> files = {folder / "scene.json"};
  for (std::size_t i = 0; i < pack.scene.meshes.size(); ++i) {
    files.push_back(folder / meshFile(i));
    if (pack.hasSourceMap()) files.push_back(folder / mapFile(i));
  }
  for (std::size_t i = 0; i < pack.scene.textures.size(); ++i) files.push_back(folder / textureFile(i));
  if (pack.scene.environment.size > 0) files.push_back(folder / kEnvironmentFile);
  return files;
}

json unpack(const pack::Pack& pack, const fs::path& folder) {
  const pack::Scene& scene = pack.scene;
  std::error_code failed;
  removeEarlier(pack, folder);
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
  writeFile(folder / "scene.json", jsonText(document, 1) + "\n");
  return document;
}

}  // namespace malus::bake
