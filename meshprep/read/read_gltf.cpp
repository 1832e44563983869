#include "meshprep/read/read_gltf.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/gltf_accessor.h"
#include "meshprep/read/gltf_buffers.h"
#include "meshprep/read/gltf_document.h"
#include "meshprep/read/gltf_draco.h"
#include "meshprep/read/gltf_json.h"
#include "meshprep/read/gltf_material.h"
#include "meshprep/read/gltf_nodes.h"
#include "meshprep/read/gltf_views.h"

namespace malus::prep {

namespace {

constexpr std::size_t kMinTriangles = 2'000'000;
constexpr std::size_t kDracoTrianglesPerByte = 2;  // Draco needs at least half a byte per triangle
constexpr std::size_t kMinVertices = 6'000'000;
constexpr std::size_t kMaxInstances = 65536;
constexpr std::size_t kMinInstancedTriangles = 4'000'000;
constexpr std::size_t kMaxCopies = 16;
constexpr std::size_t kMaxShownUri = 80;

constexpr auto kTriangles = static_cast<std::uint32_t>(gltf::PrimitiveMode::triangles);
constexpr auto kTriangleStrip = static_cast<std::uint32_t>(gltf::PrimitiveMode::triangleStrip);
constexpr auto kTriangleFan = static_cast<std::uint32_t>(gltf::PrimitiveMode::triangleFan);

// A limit of the whole file is exceeded.
class FileLimitError : public Error {
 public:
  using Error::Error;
};

// Notes of what is left out because of an error, or the error if the reading is strict or nothing is left.
class LeftOut {
 public:
  LeftOut(bool strict, std::string where, std::vector<std::string>& notes)
      : strict_(strict), where_(std::move(where)), notes_(notes) {}

  void add(const Error& error) {
    if (strict_) throw error;
    if (!first_) first_ = error;
    std::string note = error.what();
    if (note.starts_with(where_ + ": ")) note.erase(0, where_.size() + 2);
    addNote(notes_, std::move(note));
  }
  // Throws the first error, if there is one.
  void rethrowFirst() const {
    if (first_) throw Error(*first_);
  }

 private:
  bool strict_;
  std::string where_;
  std::vector<std::string>& notes_;
  std::optional<Error> first_;
};

// Makes parts of primitives and keeps account of what has been read.
class PartReader {
 public:
  PartReader(const gltf::Document& document, GltfBuffers& buffers, std::size_t fileBytes, std::string where,
             bool strict)
      : document_(document), buffers_(buffers), fileBytes_(fileBytes), where_(std::move(where)), strict_(strict) {
    for (const gltf::Mesh& mesh : document.meshes)
      for (const gltf::Primitive& primitive : mesh.primitives)
        if (primitive.position) ++users_[*primitive.position];
  }

  // Returns the faces of a primitive; empty for points and lines.
  Polygons read(const gltf::Primitive& primitive, const std::string& location, std::vector<std::string>& notes) {
    if (primitive.mode < kTriangles) {
      addNote(notes, "points and lines");
      return {};
    }
    if (primitive.mode > kTriangleFan)
      throw Error(location + ".mode", "unknown mode", "0 to 6", fmt::to_string(primitive.mode));
    if (!primitive.position) throw Error(location, "no positions", "an attribute POSITION");
    if (primitive.draco) return readDraco(primitive, location, notes);

    // Check the accessors.
    const GltfAccessor& positions = vectors(*primitive.position);
    const GltfAccessor* normals = nullptr;
    if (primitive.normal) {
      normals = &vectors(*primitive.normal);
      if (normals->count() != positions.count())
        throw Error(location, "numbers of normals and positions differ", fmt::to_string(positions.count()),
                    fmt::to_string(normals->count()));
    }

    // Read the triangles.
    Polygons polygons;
    polygons.corners = triangles(primitive, positions.count(), location, notes);
    for (std::size_t i = 3; i <= polygons.corners.size(); i += 3) polygons.firstCorner.push_back(i);

    // Read the vertices; only those of the faces if primitives share the accessor.
    std::vector<std::uint32_t> kept;
    if (users_.at(*primitive.position) > 1) {
      kept = polygons.corners;
      std::sort(kept.begin(), kept.end());
      kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
      for (std::uint32_t& corner : polygons.corners)
        corner = static_cast<std::uint32_t>(std::lower_bound(kept.begin(), kept.end(), corner) - kept.begin());
    } else {
      kept.resize(positions.count());
      std::iota(kept.begin(), kept.end(), 0u);
    }
    polygons.positions.reserve(kept.size());
    for (const std::uint32_t i : kept) polygons.positions.push_back(positions.vector(i));
    if (normals != nullptr) {
      polygons.normals.reserve(kept.size());
      for (const std::uint32_t i : kept) polygons.normals.emplace_back(normals->vector(i));
    }
    return polygons;
  }

  std::size_t triangleCount() const { return triangles_; }
  std::size_t vertexCount() const { return vertices_; }

 private:
  std::size_t bytes() const { return fileBytes_ + buffers_.bytesRead(); }

  void addTriangles(std::size_t count, std::size_t backed, const std::string& location) {
    const std::size_t most = std::max(kMinTriangles, backed);
    if (count > most || (triangles_ += count) > most)
      throw FileLimitError(location, "too many triangles for the file size", fmt::format("at most {}", most),
                           fmt::to_string(std::max(count, triangles_)));
  }
  void addVertices(std::size_t count, const std::string& location) {
    const std::size_t most = std::max(kMinVertices, bytes());
    if (count > most || (vertices_ += count) > most)
      throw FileLimitError(location, "too many vertices for the file size", fmt::format("at most {}", most),
                           fmt::to_string(std::max(count, vertices_)));
  }

  // Returns the declared count of an accessor.
  std::size_t declaredCount(std::size_t index) const {
    const std::string location = fmt::format("{}: accessors[{}]", where_, index);
    if (index >= document_.accessors.size())
      throw Error(location, "does not exist", fmt::format("one of {} accessors", document_.accessors.size()));
    return document_.accessors[index].count;
  }

  // Returns a checked accessor of vectors.
  const GltfAccessor& vectors(std::size_t index) {
    const auto found = vectors_.find(index);
    if (found != vectors_.end()) return found->second;
    GltfAccessor accessor(document_, buffers_, index,
                          where_);  // reads its buffer, whose size bounds the count
    addVertices(accessor.count(), accessor.location());
    accessor.requireVectors(document_.quantized);
    return vectors_.emplace(index, std::move(accessor)).first->second;
  }

  // Returns three corners per triangle of a list, strip or fan.
  std::vector<std::uint32_t> triangles(const gltf::Primitive& primitive, std::size_t vertices,
                                       const std::string& location, std::vector<std::string>& notes) {
    // Count corners and triangles.
    std::optional<GltfAccessor> accessor;
    if (primitive.indices) accessor.emplace(document_, buffers_, *primitive.indices, where_);
    std::size_t count = accessor ? accessor->count() : vertices;
    const bool list = primitive.mode == kTriangles;
    if (count < 3) throw Error(location, "no triangle", "3 corners or more", fmt::format("{} corners", count));
    if (list && count % 3 != 0) {
      if (strict_)
        throw Error(location, "incomplete triangle", "a multiple of 3 corners", fmt::format("{} corners", count));
      addNote(notes, "incomplete triangles at the ends of lists");
      count -= count % 3;
    }
    const std::size_t triangleCount = list ? count / 3 : count - 2;
    addTriangles(triangleCount, bytes() / 2, location);

    // Read the corners.
    std::vector<std::uint32_t> corners(count);
    if (accessor) {
      accessor->requireIndices();
      for (std::size_t i = 0; i < count; ++i) {
        corners[i] = accessor->wholeNumber(i);
        if (corners[i] == accessor->restart())
          throw Error(accessor->location(), fmt::format("primitive restart at {} is not allowed", i),
                      fmt::format("below {}", accessor->restart()), fmt::to_string(corners[i]));
        if (corners[i] >= vertices)
          throw Error(accessor->location(), fmt::format("invalid vertex index at {}", i),
                      fmt::format("below {}", vertices), fmt::to_string(corners[i]));
      }
    } else {
      std::iota(corners.begin(), corners.end(), 0u);
    }
    if (list) return corners;

    // Convert strips and fans (glTF 2.0 Specification, section 3.7.2.1).
    std::vector<std::uint32_t> result;
    result.reserve(3 * triangleCount);
    for (std::size_t i = 0; i < triangleCount; ++i) {
      const bool strip = primitive.mode == kTriangleStrip;
      const std::size_t odd = i % 2;
      const std::array<std::size_t, 3> at =
          strip ? std::array{i, i + 1 + odd, i + 2 - odd} : std::array{i + 1, i + 2, std::size_t{0}};
      for (const std::size_t corner : at) result.push_back(corners[corner]);
    }
    return result;
  }

  Polygons readDraco(const gltf::Primitive& primitive, const std::string& location, std::vector<std::string>& notes) {
    // Take the counts of the accessors, whose bytes, if any, are for readers without Draco.
    if (!primitive.indices) throw Error(location, "Draco data without indices", "an accessor of indices");
    const std::size_t corners = declaredCount(*primitive.indices);
    GltfDracoCounts counts;
    counts.vertices = declaredCount(*primitive.position);
    counts.triangles = corners / 3;
    if (corners % 3 != 0 || corners == 0)
      throw Error(location, "incomplete triangle", "a multiple of 3 corners", fmt::format("{} corners", corners));
    const gltf::DracoExtension& draco = *primitive.draco;
    const std::span<const std::byte> data = gltfViewBytes(document_, buffers_, draco.bufferView, where_);
    addTriangles(counts.triangles, bytes() / 2 + kDracoTrianglesPerByte * data.size(), location);
    addVertices(counts.vertices, location);

    // Take the ids of the attributes.
    if (!draco.position)
      throw Error(location + ".extensions.KHR_draco_mesh_compression", "no positions", "an attribute POSITION");
    counts.positionId = *draco.position;
    if (primitive.normal) counts.normalId = draco.normal;
    if (primitive.normal && !draco.normal) addNote(notes, "normals beside Draco data");

    // Decode.
    GltfDracoMesh mesh = decodeGltfDraco(data, counts, location);
    Polygons polygons;
    polygons.positions = std::move(mesh.positions);
    polygons.normals = std::move(mesh.normals);
    polygons.corners = std::move(mesh.corners);
    for (std::size_t i = 3; i <= polygons.corners.size(); i += 3) polygons.firstCorner.push_back(i);
    return polygons;
  }

  const gltf::Document& document_;
  GltfBuffers& buffers_;
  std::size_t fileBytes_;
  std::string where_;
  bool strict_;
  std::map<std::size_t, std::size_t> users_;     // primitives per accessor of positions
  std::map<std::size_t, GltfAccessor> vectors_;  // checked accessors
  std::size_t triangles_ = 0, vertices_ = 0;     // totals so far
};

std::string meshName(const gltf::Mesh& mesh, std::size_t index) {
  return mesh.name.empty() ? fmt::format("mesh {}", index) : mesh.name;
}

// Adds the parts of the placed meshes to the scene. Returns their indices, by mesh.
std::vector<std::vector<std::size_t>> readParts(const gltf::Document& document, const std::vector<bool>& placed,
                                                PartReader& reader, const std::string& where, SourceScene& scene,
                                                LeftOut& leftOut) {
  std::vector<std::vector<std::size_t>> partsOfMesh(document.meshes.size());
  for (std::size_t m = 0; m < document.meshes.size(); ++m) {
    if (!placed[m]) continue;
    const gltf::Mesh& mesh = document.meshes[m];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const gltf::Primitive& primitive = mesh.primitives[p];
      const std::string location = fmt::format("{}: meshes[{}].primitives[{}]", where, m, p);
      SourcePart part;
      part.mesh = m;
      part.meshName = meshName(mesh, m);
      part.primitive = p;
      part.name = mesh.primitives.size() == 1 ? part.meshName : fmt::format("{}.{}", part.meshName, p + 1);
      try {
        part.material = primitive.material;
        if (part.material && *part.material >= scene.materials.size())
          throw Error(location + ".material", "refers to a missing material",
                      fmt::format("an index below {}", scene.materials.size()), fmt::to_string(*primitive.material));
        part.polygons = reader.read(primitive, location, scene.notes);
      } catch (const FileLimitError&) {
        throw;
      } catch (const Error& error) {
        leftOut.add(error);
        continue;
      }
      if (part.polygons.faceCount() == 0) continue;
      partsOfMesh[m].push_back(scene.parts.size());
      scene.parts.push_back(std::move(part));
    }
  }
  return partsOfMesh;
}

}  // namespace

SourceScene readGltf(const std::filesystem::path& path, bool strict) {
  const std::string where = path.string();
  SourceScene scene;
  LeftOut leftOut(strict, where, scene.notes);

  // Parse the document.
  const GltfContainer container(path);
  GltfJson checked = parseGltfJson(container.json(), where, strict);
  scene.notes = std::move(checked.notes);
  gltf::Document document = gltf::toDocument(std::move(checked.document), where);
  for (const gltf::Buffer& buffer : document.buffers)
    if (!isDataUri(buffer.uri) && hasBackslash(buffer.uri))
      addNote(scene.notes,
              fmt::format("{}backslashes in the file name {}", kAcceptedNote, buffer.uri.substr(0, kMaxShownUri)));
  GltfBuffers buffers(std::move(document.buffers), container, path);

  // Convert the materials.
  for (std::size_t i = 0; i < document.materials.size(); ++i)
    scene.materials.push_back(gltfMaterial(
        document.materials[i], fmt::format("{}materials[{}]", strict ? where + ": " : "", i), scene.notes, strict));

  // Place the meshes. Meshes without a placement are not read.
  const auto leaveOut = [&](const Error& error) { leftOut.add(error); };
  const GltfPlacements all = gltfPlacements(document, kMaxInstances, where, scene.notes, leaveOut);
  const std::vector<GltfPlacement>& placements = all.meshes;
  if (placements.empty()) leftOut.rethrowFirst();
  if (placements.empty()) throw Error(where, "no mesh in the scene", "a node with a mesh");
  std::vector<bool> placed(document.meshes.size(), false);
  for (const GltfPlacement& placement : placements) placed[placement.object] = true;
  if (std::find(placed.begin(), placed.end(), false) != placed.end()) addNote(scene.notes, "meshes without a node");

  // Convert the cameras and the lights.
  scene.cameras = gltfCameras(document, all.cameras, where, leaveOut);
  scene.lights = gltfLights(document, all.lights, where, leaveOut);
  if (all.cameras.empty() && !document.cameras.empty())
    addNote(scene.notes, fmt::format("cameras without a node ({})", document.cameras.size()));
  if (all.lights.empty() && !document.lights.empty())
    addNote(scene.notes, fmt::format("lights without a node ({})", document.lights.size()));

  // Read the parts.
  PartReader reader(document, buffers, container.size(), where, strict);
  const std::vector<std::vector<std::size_t>> partsOfMesh = readParts(document, placed, reader, where, scene, leftOut);
  if (scene.parts.empty()) leftOut.rethrowFirst();
  if (scene.parts.empty()) throw Error(where, "file has no faces", "a mesh");

  // Make the instances, with a bounded number of triangles.
  const std::size_t most = std::max(kMinInstancedTriangles, kMaxCopies * reader.triangleCount());
  const std::size_t mostVertices = std::max(3 * most, reader.vertexCount());
  std::size_t triangles = 0, vertices = 0;
  for (const GltfPlacement& placement : placements) {
    const std::vector<std::size_t>& parts = partsOfMesh[placement.object];
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

std::vector<std::filesystem::path> gltfBufferFiles(const std::filesystem::path& path) {
  const std::string where = path.string();
  const GltfContainer container(path);
  const gltf::Document document = gltf::toDocument(parseGltfJson(container.json(), where, false).document, where);
  std::set<std::filesystem::path> files;
  for (std::size_t i = 0; i < document.buffers.size(); ++i) {
    const std::string& uri = document.buffers[i].uri;
    if (uri.empty() || isDataUri(uri)) continue;
    files.insert(resolveGltfUri(path, uri, fmt::format("{}: buffers[{}].uri", where, i)));
  }
  return {files.begin(), files.end()};
}

}  // namespace malus::prep
