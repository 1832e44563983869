#include "meshprep/read/source_scene.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/read/read_gltf.h"
#include "meshprep/read/read_mesh.h"
#include "meshprep/read/read_mtl.h"

namespace malus::prep {

namespace {

constexpr std::size_t kMaxNotes = 100;  // garbage may give reason for millions

std::string extensionOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// The faces, with what is known about each and the vertices that they use.
void takeFaces(const Polygons& source, const std::vector<std::size_t>& faces, SourcePart& part) {
  Polygons& result = part.polygons;
  result.locationsAreBytes = source.locationsAreBytes;

  // Step 1: the vertices, in their order.
  std::vector<std::uint32_t>& kept = part.fileVertices;
  for (const std::size_t f : faces)
    for (const std::uint32_t corner : source.face(f)) kept.push_back(corner);
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  for (const std::uint32_t v : kept) {
    result.positions.push_back(source.positions[v]);
    if (!source.normals.empty()) result.normals.push_back(source.normals[v]);
    if (!source.vertexLocations.empty()) result.vertexLocations.push_back(source.vertexLocations[v]);
  }

  // Step 2: the faces.
  for (const std::size_t f : faces) {
    for (std::size_t c = source.firstCorner[f]; c < source.firstCorner[f + 1]; ++c) {
      const auto found = std::lower_bound(kept.begin(), kept.end(), source.corners[c]);
      result.corners.push_back(static_cast<std::uint32_t>(found - kept.begin()));
      if (!source.cornerNormals.empty()) result.cornerNormals.push_back(source.cornerNormals[c]);
    }
    result.closeFace();
    if (!source.smoothingGroups.empty()) result.smoothingGroups.push_back(source.smoothingGroups[f]);
    if (!source.faceLocations.empty()) result.faceLocations.push_back(source.faceLocations[f]);
    part.fileFaces.push_back(static_cast<std::uint32_t>(f));
  }
}

}  // namespace

void addNote(std::vector<std::string>& notes, std::string note) {
  if (notes.size() > kMaxNotes || std::find(notes.begin(), notes.end(), note) != notes.end()) return;
  notes.push_back(notes.size() == kMaxNotes ? "and more" : std::move(note));
}

bool isGltf(const std::filesystem::path& path) {
  const std::string extension = extensionOf(path);
  return extension == ".gltf" || extension == ".glb";
}

SourceScene splitByMaterial(Polygons polygons) {
  SourceScene scene;
  for (std::string& note : polygons.notes) addNote(scene.notes, std::move(note));
  polygons.notes.clear();

  // Step 1: which faces go together.
  const auto materialOf = [&](std::size_t face) -> const std::string& {
    static const std::string kNone;
    return polygons.partOf.empty() || polygons.parts.empty() ? kNone : polygons.parts[polygons.partOf[face]].material;
  };
  std::map<std::string, std::size_t> groupOf;
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::string> names;
  for (std::size_t f = 0; f < polygons.faceCount(); ++f) {
    const auto [found, isNew] = groupOf.emplace(materialOf(f), groups.size());
    if (isNew) {
      groups.emplace_back();
      names.push_back(found->first);
    }
    groups[found->second].push_back(f);
  }

  // Step 2: a part for each. One part is the file as it is.
  scene.parts.resize(groups.size());
  if (groups.size() == 1)
    scene.parts.front().polygons = std::move(polygons);
  else
    for (std::size_t g = 0; g < groups.size(); ++g) takeFaces(polygons, groups[g], scene.parts[g]);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    SourcePart& part = scene.parts[g];
    part.name = names[g];
    if (!names[g].empty()) {
      part.material = scene.materials.size();
      SourceMaterial material;
      material.name = names[g];
      scene.materials.push_back(std::move(material));
    }
    scene.instances.push_back({g, part.name, glm::dmat4(1.0)});
  }
  return scene;
}

SourceScene readSourceScene(const std::filesystem::path& path) {
  if (isGltf(path)) return readGltf(path);
  Polygons polygons = readMesh(path);
  const std::vector<std::string> files = polygons.materialFiles;
  SourceScene scene = splitByMaterial(std::move(polygons));
  if (!scene.materials.empty() || !files.empty()) describeMaterials(scene, path, files);
  for (std::size_t i = 0; i < scene.parts.size(); ++i)
    if (scene.parts[i].name.empty()) scene.parts[i].name = scene.instances[i].name = path.stem().string();
  return scene;
}

Polygons merged(const SourceScene& scene) {
  Polygons result;
  result.notes = scene.notes;
  // Where some part has normals, the others have none: zero.
  const bool normals = std::any_of(scene.parts.begin(), scene.parts.end(),
                                   [](const SourcePart& part) { return !part.polygons.normals.empty(); });
  for (const SourceInstance& instance : scene.instances) {
    const SourcePart& part = scene.parts[instance.part];
    const Polygons& source = part.polygons;
    const auto firstVertex = static_cast<std::uint32_t>(result.positions.size());
    const glm::dmat3 m(instance.worldFromObject);
    const glm::dmat3 normalMatrix(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const bool mirrors = glm::dot(m[0], glm::cross(m[1], m[2])) < 0;

    // Step 1: vertices, in world space.
    for (const glm::dvec3& p : source.positions)
      result.positions.push_back(m * p + glm::dvec3(instance.worldFromObject[3]));
    if (normals && source.normals.empty()) result.normals.resize(result.positions.size(), glm::vec3(0));
    if (normals)
      for (const glm::vec3& n : source.normals) {
        const glm::dvec3 turned = normalMatrix * glm::dvec3(n) * (mirrors ? -1.0 : 1.0);
        const double length = glm::length(turned);
        result.normals.emplace_back(length > 0 ? turned / length : glm::dvec3(0));
      }

    // Step 2: faces, as a part of their own.
    for (std::size_t f = 0; f < source.faceCount(); ++f) {
      const auto face = source.face(f);
      for (std::size_t c = 0; c < face.size(); ++c)
        result.corners.push_back(firstVertex + face[mirrors ? (face.size() - c) % face.size() : c]);
      result.closeFace();
      result.partOf.push_back(static_cast<std::uint32_t>(result.parts.size()));
    }
    result.parts.push_back({instance.name, part.material ? scene.materials[*part.material].name : std::string()});
  }
  return result;
}

std::vector<std::filesystem::path> referencedFiles(const std::filesystem::path& path) {
  if (isGltf(path)) return gltfBufferFiles(path);
  if (extensionOf(path) != ".obj") return {};
  return listMaterialFiles(path, listMtllibs(readTextFile(path), path.string()));
}

}  // namespace malus::prep
