#include "meshprep/read/read_gltf.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/counted_note.h"
#include "meshprep/read/gltf_buffers.h"
#include "meshprep/read/gltf_document.h"
#include "meshprep/read/gltf_images.h"
#include "meshprep/read/gltf_json.h"
#include "meshprep/read/gltf_left_out.h"
#include "meshprep/read/gltf_material.h"
#include "meshprep/read/gltf_nodes.h"
#include "meshprep/read/gltf_pose.h"
#include "meshprep/read/gltf_primitives.h"
#include "meshprep/read/gltf_views.h"

namespace malus::prep {

namespace {

constexpr std::size_t kMaxInstances = 65536;
constexpr std::size_t kMinInstancedTriangles = 4'000'000;
constexpr std::size_t kMaxCopies = 16;
constexpr std::size_t kMaxShownUri = 80;

std::string meshName(const gltf::Mesh& mesh, std::size_t index) {
  return mesh.name.empty() ? fmt::format("mesh {}", index) : mesh.name;
}

// Texture attributes that are read of primitives.
class PrimitiveNeeds {
 public:
  PrimitiveNeeds(const std::vector<SourceMaterial>& materials, KeepTextures textures)
      : materials_(materials), textures_(textures) {}

  TextureNeeds of(const gltf::Primitive& primitive) const {
    if (textures_ == KeepTextures::all) return {{true, true}, true};
    if (textures_ == KeepTextures::none || !primitive.material || *primitive.material >= materials_.size()) return {};
    return textureNeeds(materials_[*primitive.material]);
  }

  // Adds notes about the attributes that are not read.
  void noteOthers(const gltf::Document& document, std::vector<std::string>& notes) const {
    std::size_t coordinates = 0, tangents = 0;
    for (const gltf::Mesh& mesh : document.meshes)
      for (const gltf::Primitive& primitive : mesh.primitives) {
        const TextureNeeds needs = of(primitive);
        for (std::size_t set = 0; set < needs.coordinates.size(); ++set)
          coordinates += primitive.texCoords[set] && !needs.coordinates[set] ? 1 : 0;
        if (needs.tangents) continue;
        tangents += primitive.tangent ? 1 : 0;
        for (const gltf::MorphTarget& target : primitive.targets) tangents += target.tangent ? 1 : 0;
      }
    const bool areUnused = textures_ == KeepTextures::needed;
    if (tangents > 0) addNote(notes, countedNote(areUnused ? kUnusedTangentsNote : kTangentsNote, tangents, {}));
    if (coordinates > 0)
      addNote(notes, countedNote(areUnused ? kUnusedCoordinatesNote : kTextureCoordinatesNote, coordinates, {}));
  }

 private:
  const std::vector<SourceMaterial>& materials_;
  KeepTextures textures_;
};

// Adds the parts of the placed meshes to the scene, once for each pose of a mesh. Returns their indices, by placement.
class PartReader {
 public:
  PartReader(const gltf::Document& document, GltfBuffers& buffers, GltfPrimitiveReader& reader,
             const PrimitiveNeeds& needs, const GltfPlacements& placements, const std::string& where,
             SourceScene& scene, GltfLeftOut& leftOut)
      : document_(document),
        buffers_(buffers),
        reader_(reader),
        needs_(needs),
        placements_(placements),
        where_(where),
        scene_(scene),
        leftOut_(leftOut) {}

  std::vector<std::vector<std::size_t>> read() {
    std::map<std::tuple<std::size_t, std::vector<double>, std::optional<std::size_t>>, std::vector<std::size_t>> known;
    std::vector<std::vector<std::size_t>> parts;
    for (const GltfPlacement& placement : placements_.meshes) {
      const auto [found, isNew] = known.try_emplace({placement.object, placement.morphWeights, placement.skin});
      if (isNew) found->second = readMesh(placement);
      parts.push_back(found->second);
    }
    return parts;
  }

 private:
  std::vector<std::size_t> readMesh(const GltfPlacement& placement) {
    const std::size_t m = placement.object;
    const gltf::Mesh& mesh = document_.meshes[m];
    std::vector<std::size_t> parts;
    std::optional<GltfPose> pose;
    try {
      pose.emplace(document_, buffers_, placement, placements_.worldFromNode, where_);
    } catch (const Error& error) {
      leftOut_.addPart(error);
      return parts;
    }
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const gltf::Primitive& primitive = mesh.primitives[p];
      if (primitive.isInvalid) continue;
      const std::string location = fmt::format("{}: meshes[{}].primitives[{}]", where_, m, p);
      SourcePart part;
      part.mesh = m;
      part.meshName = meshName(mesh, m);
      part.primitive = p;
      part.name = mesh.primitives.size() == 1 ? part.meshName : fmt::format("{}.{}", part.meshName, p + 1);
      try {
        part.material = primitive.material;
        if (part.material && *part.material >= scene_.materials.size())
          throw Error(location + ".material", "refers to a missing material",
                      fmt::format("an index below {}", scene_.materials.size()), fmt::to_string(*primitive.material));
        part.polygons = reader_.read(primitive, needs_.of(primitive), *pose, location);
      } catch (const GltfLimitError&) {
        throw;
      } catch (const Error& error) {  // of the primitive, or of an accessor, which does not name the primitive
        leftOut_.addPart(
            std::string_view(error.what()).starts_with(location) ? error : Error(location, leftOut_.shortText(error)));
        continue;
      }
      if (part.polygons.faceCount() == 0) continue;
      parts.push_back(scene_.parts.size());
      scene_.parts.push_back(std::move(part));
    }
    return parts;
  }

  const gltf::Document& document_;
  GltfBuffers& buffers_;
  GltfPrimitiveReader& reader_;
  const PrimitiveNeeds& needs_;
  const GltfPlacements& placements_;
  const std::string& where_;
  SourceScene& scene_;
  GltfLeftOut& leftOut_;
};

}  // namespace

SourceScene readGltf(const std::filesystem::path& path, bool strict, bool withImages, KeepTextures textures) {
  const std::string where = path.string();
  SourceScene scene;
  GltfLeftOut leftOut(strict, where, scene.notes);

  // Parse the document.
  const GltfContainer container(path);
  if (container.trailingBytes() > 0)
    addNote(scene.notes, fmt::format("{}{} bytes behind the end of the GLB", kAcceptedNote, container.trailingBytes()));
  gltf::Document document = gltf::toDocument(parseGltfJson(container.json(), where, leftOut), where, leftOut);
  for (const gltf::Buffer& buffer : document.buffers)
    if (!isDataUri(buffer.uri) && hasBackslash(buffer.uri))
      addNote(scene.notes,
              fmt::format("{}backslashes in the file name {}", kAcceptedNote, buffer.uri.substr(0, kMaxShownUri)));
  GltfBuffers buffers(std::move(document.buffers), container, path);

  scene.images = gltfImages(document, buffers, path, withImages, leftOut);

  // Convert the materials.
  for (std::size_t i = 0; i < document.materials.size(); ++i)
    scene.materials.push_back(gltfMaterial(document, document.materials[i],
                                           fmt::format("{}materials[{}]", strict ? where + ": " : "", i), scene.notes,
                                           strict));

  // Place the meshes. Meshes without a placement are not read.
  const GltfPlacements all = gltfPlacements(document, buffers, kMaxInstances, where, leftOut);
  const std::vector<GltfPlacement>& placements = all.meshes;
  if (placements.empty()) leftOut.rethrowFirst();
  if (placements.empty()) throw Error(where, "no mesh in the scene", "a node with a mesh");
  std::vector<bool> placed(document.meshes.size(), false);
  for (const GltfPlacement& placement : placements) placed[placement.object] = true;
  if (std::find(placed.begin(), placed.end(), false) != placed.end()) addNote(scene.notes, "meshes without a node");

  // Convert the cameras and the lights.
  scene.cameras = gltfCameras(document, all.cameras, where, leftOut);
  scene.lights = gltfLights(document, all.lights, where, leftOut);
  if (all.cameras.empty() && !document.cameras.empty())
    addNote(scene.notes, fmt::format("cameras without a node ({})", document.cameras.size()));
  if (all.lights.empty() && !document.lights.empty())
    addNote(scene.notes, fmt::format("lights without a node ({})", document.lights.size()));

  // Read the parts.
  GltfPrimitiveReader reader(document, buffers, container.size(), where, leftOut);
  const PrimitiveNeeds needs(scene.materials, textures);
  const std::vector<std::vector<std::size_t>> partsOfPlacement =
      PartReader(document, buffers, reader, needs, all, where, scene, leftOut).read();
  needs.noteOthers(document, scene.notes);
  if (scene.parts.empty()) leftOut.rethrowFirst();
  if (scene.parts.empty()) throw Error(where, "file has no faces", "a mesh");

  // Make the instances, with a bounded number of triangles.
  const std::size_t most = std::max(kMinInstancedTriangles, kMaxCopies * reader.triangleCount());
  const std::size_t mostVertices = std::max(3 * most, reader.vertexCount());
  std::size_t triangles = 0, vertices = 0;
  for (std::size_t n = 0; n < placements.size(); ++n) {
    const GltfPlacement& placement = placements[n];
    const std::vector<std::size_t>& parts = partsOfPlacement[n];
    for (std::size_t i = 0; i < parts.size(); ++i) {
      triangles += scene.parts[parts[i]].polygons.faceCount();
      vertices += scene.parts[parts[i]].polygons.positions.size();
      if (scene.instances.size() == kMaxInstances || triangles > most || vertices > mostVertices)
        throw Error(where, "too many instances",
                    fmt::format("at most {}, of {} triangles and {} vertices", kMaxInstances, most, mostVertices),
                    fmt::format("{}, {} and {} or more", scene.instances.size() + 1, triangles, vertices));
      scene.instances.push_back({parts[i],
                                 parts.size() == 1 ? placement.name : fmt::format("{}.{}", placement.name, i + 1),
                                 placement.worldFromObject, placement.name});
    }
  }
  return scene;
}

std::vector<std::filesystem::path> gltfFiles(const std::filesystem::path& path) {
  const std::string where = path.string();
  std::vector<std::string> notes;
  GltfLeftOut leftOut(false, where, notes);
  const GltfContainer container(path);
  const gltf::Document document = gltf::toDocument(parseGltfJson(container.json(), where, leftOut), where, leftOut);
  std::set<std::filesystem::path> files;
  const auto add = [&](const std::string& uri, const char* list, std::size_t i) {
    if (uri.empty() || isDataUri(uri)) return;
    try {
      files.insert(resolveGltfUri(path, uri, fmt::format("{}: {}[{}].uri", where, list, i)));
    } catch (const Error&) {  // readGltf() does not open it either
      return;
    }
  };
  for (std::size_t i = 0; i < document.buffers.size(); ++i) add(document.buffers[i].uri, "buffers", i);
  for (std::size_t i = 0; i < document.images.size(); ++i) add(document.images[i].uri, "images", i);
  return {files.begin(), files.end()};
}

}  // namespace malus::prep
