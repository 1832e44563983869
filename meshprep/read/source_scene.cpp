#include "meshprep/read/source_scene.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/read/counted_note.h"
#include "meshprep/read/read_gltf.h"
#include "meshprep/read/read_mesh.h"
#include "meshprep/read/read_mtl.h"

namespace malus::prep {

namespace {

constexpr std::size_t kMaxNotes = 100;  // invalid files could cause millions

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// Copies the faces with their attributes and vertices.
void copyFaces(const Polygons& source, const std::vector<std::size_t>& faces, SourcePart& part) {
  Polygons& result = part.polygons;
  result.locationsAreBytes = source.locationsAreBytes;

  // Copy the used vertices in their order.
  std::vector<std::uint32_t>& used = part.fileVertices;
  for (const std::size_t f : faces)
    for (const std::uint32_t corner : source.face(f)) used.push_back(corner);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::uint32_t v : used) {
    result.positions.push_back(source.positions[v]);
    if (!source.normals.empty()) result.normals.push_back(source.normals[v]);
    if (!source.vertexLocations.empty()) result.vertexLocations.push_back(source.vertexLocations[v]);
  }

  // Copy the faces.
  for (const std::size_t f : faces) {
    for (std::size_t c = source.firstCorner[f]; c < source.firstCorner[f + 1]; ++c) {
      const auto found = std::lower_bound(used.begin(), used.end(), source.corners[c]);
      result.corners.push_back(static_cast<std::uint32_t>(found - used.begin()));
      if (!source.cornerNormals.empty()) result.cornerNormals.push_back(source.cornerNormals[c]);
      for (std::size_t set = 0; set < source.textureCoordinates.size(); ++set)
        if (!source.textureCoordinates[set].empty())
          result.textureCoordinates[set].push_back(source.textureCoordinates[set][c]);
    }
    result.closeFace();
    if (!source.smoothingGroups.empty()) result.smoothingGroups.push_back(source.smoothingGroups[f]);
    if (!source.faceLocations.empty()) result.faceLocations.push_back(source.faceLocations[f]);
    part.fileFaces.push_back(static_cast<std::uint32_t>(f));
  }
}

// Drops the texture coordinates that are not kept, and replaces the note about them unless all are left out.
void keepCoordinates(SourceScene& scene, KeepTextures textures) {
  bool anyKept = false, anyDropped = false;
  for (SourcePart& part : scene.parts) {
    if (!part.polygons.hasTextureAttributes()) continue;
    const bool isNeeded = part.material && textureNeeds(scene.materials[*part.material]).coordinates[0];
    const bool isKept = textures == KeepTextures::all || (textures == KeepTextures::needed && isNeeded);
    (isKept ? anyKept : anyDropped) = true;
    if (!isKept) part.polygons.dropTextureAttributes();
  }
  if (textures != KeepTextures::none) {
    std::erase(scene.notes, kTextureCoordinatesNote);
    if (anyDropped) addNote(scene.notes, std::string(kUnusedCoordinatesNote));
  }
  if (!anyKept) std::erase(scene.notes, kMissingCoordinatesNote);
}

}  // namespace

void addNote(std::vector<std::string>& notes, std::string note) {
  if (notes.size() > kMaxNotes || std::find(notes.begin(), notes.end(), note) != notes.end()) return;
  notes.push_back(notes.size() == kMaxNotes ? "and more" : std::move(note));
}

void keepTextureCoordinates(Polygons& polygons, bool isKept) {
  if (isKept && polygons.hasTextureAttributes()) {
    std::erase(polygons.notes, kTextureCoordinatesNote);
  } else {
    polygons.dropTextureAttributes();
    std::erase(polygons.notes, kMissingCoordinatesNote);
  }
}

bool isGltf(const std::filesystem::path& path) {
  const std::string extension = lowerExtension(path);
  return extension == ".gltf" || extension == ".glb";
}

SourceScene splitByMaterial(Polygons polygons) {
  SourceScene scene;
  for (std::string& note : polygons.notes) addNote(scene.notes, std::move(note));
  polygons.notes.clear();

  // Group the faces by material.
  const auto materialName = [&](std::size_t face) -> const std::string& {
    static const std::string kNone;
    return polygons.partOf.empty() || polygons.parts.empty() ? kNone : polygons.parts[polygons.partOf[face]].material;
  };
  std::map<std::string, std::size_t> groupByName;
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::string> names;
  for (std::size_t f = 0; f < polygons.faceCount(); ++f) {
    const auto [found, isNew] = groupByName.emplace(materialName(f), groups.size());
    if (isNew) {
      groups.emplace_back();
      names.push_back(found->first);
    }
    groups[found->second].push_back(f);
  }

  // Make a part per group. A single part keeps the polygons unchanged.
  scene.parts.resize(groups.size());
  if (groups.size() == 1)
    scene.parts.front().polygons = std::move(polygons);
  else
    for (std::size_t g = 0; g < groups.size(); ++g) copyFaces(polygons, groups[g], scene.parts[g]);
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

TextureNeeds textureNeeds(const SourceMaterial& material) {
  TextureNeeds needs;
  const auto add = [&](const std::optional<std::size_t>& image, const SourcePlacement& place) {
    if (image && place.set < needs.coordinates.size()) needs.coordinates[place.set] = true;
  };
  add(material.baseColourImage, material.baseColourPlacement);
  add(material.metallicRoughnessImage, material.metallicRoughnessPlacement);
  add(material.emissiveImage, material.emissivePlacement);
  add(material.specularGlossinessImage, material.specularGlossinessPlacement);
  add(material.normalImage, material.normalPlacement);
  add(material.transmissionImage, material.transmissionPlacement);
  add(material.coverageImage, material.coveragePlacement);
  needs.tangents = material.normalImage.has_value();
  return needs;
}

SourceScene readSourceScene(const std::filesystem::path& path, bool strict, bool withImages, KeepTextures textures) {
  if (isGltf(path)) return readGltf(path, strict, withImages, textures);
  Polygons polygons = readMesh(path, strict);
  const std::vector<std::string> files = polygons.materialFiles;
  SourceScene scene = splitByMaterial(std::move(polygons));
  if (!scene.materials.empty() || !files.empty()) describeMaterials(scene, path, files, strict);
  for (std::size_t i = 0; i < scene.parts.size(); ++i)
    if (scene.parts[i].name.empty()) scene.parts[i].name = scene.instances[i].name = path.stem().string();
  keepCoordinates(scene, textures);
  return scene;
}

namespace {

// Merges the texture attributes of instances. Those of parts without are zero.
class TextureMerge {
 public:
  TextureMerge(const SourceScene& scene, std::span<const std::size_t> instances, Polygons& result) : result_(result) {
    for (const std::size_t index : instances) {
      const Polygons& source = scene.parts[scene.instances[index].part].polygons;
      for (std::size_t set = 0; set < hasSet_.size(); ++set)
        hasSet_[set] = hasSet_[set] || !source.textureCoordinates[set].empty();
      hasTangents_ = hasTangents_ || !source.tangents.empty();
    }
  }

  // Appends those of a corner of `source`, whose instance has this transform. A mirror image has the bitangents of the
  // source, mirrored, but the cross product of normal and tangent changes its sign.
  void add(const Polygons& source, std::size_t corner, const glm::dmat3& transform, bool mirrors) {
    for (std::size_t set = 0; set < hasSet_.size(); ++set)
      if (hasSet_[set]) {
        const std::vector<glm::vec2>& from = source.textureCoordinates[set];
        result_.textureCoordinates[set].push_back(from.empty() ? glm::vec2(0) : from[corner]);
      }
    if (!hasTangents_) return;
    const glm::vec4 t = source.tangents.empty() ? glm::vec4(0, 0, 0, 1) : source.tangents[corner];
    const glm::dvec3 tangent = transform * glm::dvec3(t);
    const double length = glm::length(tangent);
    result_.tangents.emplace_back(length > 0 ? tangent / length : glm::dvec3(0), mirrors ? -t.w : t.w);
  }

 private:
  Polygons& result_;
  std::array<bool, 2> hasSet_{};
  bool hasTangents_ = false;
};

}  // namespace

Polygons mergeInstances(const SourceScene& scene) {
  std::vector<std::size_t> all(scene.instances.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return mergeInstances(scene, all);
}

std::vector<std::string> notesOfMeshes(const SourceScene& scene) {
  std::vector<std::string> notes = scene.notes;
  for (std::string& note : viewNotes(scene.cameras, scene.lights)) addNote(notes, std::move(note));
  return notes;
}

Polygons mergeInstances(const SourceScene& scene, std::span<const std::size_t> instances) {
  Polygons result;
  result.notes = notesOfMeshes(scene);
  std::size_t vertices = 0, corners = 0, faces = 0;
  for (const std::size_t index : instances) {
    const Polygons& source = scene.parts[scene.instances[index].part].polygons;
    vertices += source.positions.size();
    corners += source.corners.size();
    faces += source.faceCount();
  }
  result.positions.reserve(vertices);
  result.corners.reserve(corners);
  result.firstCorner.reserve(faces + 1);
  result.partOf.reserve(faces);

  TextureMerge textures(scene, instances, result);

  // If any part has normals, set those of the others to zero.
  const bool normals = std::any_of(scene.parts.begin(), scene.parts.end(),
                                   [](const SourcePart& part) { return !part.polygons.normals.empty(); });
  if (normals) result.normals.reserve(vertices);
  for (const std::size_t index : instances) {
    const SourceInstance& instance = scene.instances[index];
    const SourcePart& part = scene.parts[instance.part];
    const Polygons& source = part.polygons;
    const auto firstVertex = static_cast<std::uint32_t>(result.positions.size());
    const glm::dmat3 m(instance.worldFromObject);
    const glm::dmat3 normalMatrix(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const bool mirrors = glm::dot(m[0], glm::cross(m[1], m[2])) < 0;

    // Transform the vertices to world space.
    for (const glm::dvec3& p : source.positions) result.positions.push_back(toWorld(instance, p));
    if (normals && source.normals.empty()) result.normals.resize(result.positions.size(), glm::vec3(0));
    if (normals)
      for (const glm::vec3& n : source.normals) {
        const glm::dvec3 normal = normalMatrix * glm::dvec3(n) * (mirrors ? -1.0 : 1.0);
        const double length = glm::length(normal);
        result.normals.emplace_back(length > 0 ? normal / length : glm::dvec3(0));
      }

    // Append the faces as a part.
    for (std::size_t f = 0; f < source.faceCount(); ++f) {
      const auto face = source.face(f);
      for (std::size_t c = 0; c < face.size(); ++c) {
        const std::size_t corner = mirrors ? (face.size() - c) % face.size() : c;
        result.corners.push_back(firstVertex + face[corner]);
        textures.add(source, source.firstCorner[f] + corner, m, mirrors);
      }
      result.closeFace();
      result.partOf.push_back(static_cast<std::uint32_t>(result.parts.size()));
    }
    result.parts.push_back({instance.name, part.material ? scene.materials[*part.material].name : std::string()});
  }
  return result;
}

std::vector<std::filesystem::path> referencedFiles(const std::filesystem::path& path) {
  if (isGltf(path)) return gltfFiles(path);
  if (lowerExtension(path) != ".obj") return {};
  std::vector<std::filesystem::path> files = listMaterialFiles(path, listMtllibs(readTextFile(path), path.string()));
  std::vector<SourceImage> images;
  for (const std::filesystem::path& file : files) {
    std::error_code ignored;
    std::vector<std::string> notes;
    try {
      if (std::filesystem::is_regular_file(file, ignored)) readMtl(file, notes, images);
    } catch (const Error&) {  // its materials are not read either
      continue;
    }
  }
  for (const SourceImage& image : images)
    if (std::find(files.begin(), files.end(), image.file) == files.end()) files.push_back(image.file);
  return files;
}

}  // namespace malus::prep
