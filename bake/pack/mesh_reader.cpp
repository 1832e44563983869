#include "bake/pack/mesh_reader.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "bake/pack/field_io.h"
#include "bake/pack/record_fields.h"
#include "meshprep/base/error.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/compress/grid_rounding.h"

namespace malus::pack {

namespace {

void checkEntry(const ByteReader& r, const MeshEntry& entry, std::size_t materials, std::size_t geometryBytes,
                std::uint64_t end) {
  if (entry.material >= materials)
    r.fail(fmt::format("material of mesh '{}' is out of range", entry.name),
           fmt::format("an index below {}", materials), fmt::format("{}", entry.material));
  // Meshes are in order and do not overlap: no byte is decoded twice, so a small file cannot claim the same mesh many
  // times.
  if (entry.offset % kAlignment != 0 || entry.offset < end || entry.offset > geometryBytes ||
      entry.sizeBytes > geometryBytes - entry.offset)
    r.fail(fmt::format("geometry of mesh '{}'", entry.name),
           fmt::format("bytes from {} on within the {} of section GEOM", end, geometryBytes),
           fmt::format("offset {}, size {}", entry.offset, entry.sizeBytes));
}

// version: that of the section MESH; in version 1, positions are floats.
compress::TriangleMesh decodeGeometry(const MeshEntry& entry, const compress::TextureGrids& textures,
                                      std::uint32_t version, std::span<const std::byte> bytes, std::string_view where) {
  const std::string location = fmt::format("{}, mesh '{}'", where, entry.name);
  const compress::Limits limits{entry.vertices, entry.triangles};
  if (version == 1) return compress::decodeFloats(bytes, limits, location);
  return compress::decode(bytes, limits, {entry.gridOrigin, entry.gridStep, compress::kMaxPositionBits}, location,
                          textures);
}

Mesh decodeMesh(const ByteReader& r, const MeshEntry& entry, const compress::TextureGrids& textures,
                std::uint32_t version, std::span<const std::byte> bytes, std::string_view where) {
  compress::TriangleMesh decoded = decodeGeometry(entry, textures, version, bytes, where);
  const bool hasNormals = (entry.flags & kNormalsFlag) != 0;
  if (decoded.normals.empty() == hasNormals)
    r.fail(fmt::format("normals of mesh '{}'", entry.name), hasNormals ? "normals, by its flags" : "none, by its flags",
           hasNormals ? "none" : "normals");
  if (!compress::isFloat(entry.origin))
    r.fail(fmt::format("origin of mesh '{}'", entry.name), "coordinates that are floats", "more digits");
  for (const glm::dvec3& p : decoded.positions) {
    const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (farthest > kMaxCoordinate)
      r.fail(fmt::format("positions of mesh '{}'", entry.name),
             fmt::format("coordinates within {:g} m of the scene's origin", kMaxCoordinate),
             fmt::format("{:g} m", farthest));
    if (!compress::isFloat(p - entry.origin))
      r.fail(fmt::format("positions of mesh '{}'", entry.name), "floats, relative to the origin of the mesh",
             "more digits");
  }
  Mesh mesh;
  mesh.name = entry.name;
  mesh.material = entry.material;
  mesh.openSurface = (entry.flags & kOpenSurfaceFlag) != 0;
  mesh.origin = entry.origin;
  mesh.positions = std::move(decoded.positions);
  mesh.normals = std::move(decoded.normals);
  mesh.triangles = std::move(decoded.triangles);
  mesh.textureCoordinates = std::move(decoded.textureCoordinates);
  mesh.tangents = std::move(decoded.tangents);
  return mesh;
}

struct ReadEntry {
  MeshEntry entry;
  ByteReader end;  // behind the entry, for errors
};

// Decodes all meshes in parallel, the largest first. Throws the error of the first mesh that has one.
std::vector<Mesh> decodeMeshes(std::span<const ReadEntry> entries, const std::vector<TextureEncoding>& textures,
                               std::uint32_t version, std::span<const std::byte> geometry, std::string_view where) {
  namespace tbb = oneapi::tbb;
  std::vector<std::size_t> order(entries.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return entries[a].entry.triangles > entries[b].entry.triangles;
  });
  std::vector<Mesh> meshes(entries.size());
  std::vector<std::exception_ptr> errors(entries.size());
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(std::size_t{0}, entries.size(), [&](std::size_t) {
    const std::size_t i = order[next++];
    const MeshEntry& entry = entries[i].entry;
    try {
      meshes[i] = decodeMesh(
          entries[i].end, entry, i < textures.size() ? textures[i].grids : compress::TextureGrids{}, version,
          geometry.subspan(static_cast<std::size_t>(entry.offset), static_cast<std::size_t>(entry.sizeBytes)), where);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return meshes;
}

// Reads the table up to its end or to its first error, which is returned.
std::exception_ptr readEntries(ByteReader r, std::uint32_t version, std::size_t geometryBytes,
                               std::uint64_t geometryOffset, Pack& pack, std::vector<ReadEntry>& entries) try {
  FieldSizes sizes({kMeshes, version});
  const MeshEntry any{};
  visitMeshEntry(sizes, any);
  const std::uint32_t count = r.count(sizes.bytes(), kMaxMeshes, "number of meshes");
  if (count == 0) r.fail("number of meshes", "at least 1", "0");
  std::uint64_t vertices = 0, triangles = 0, end = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    MeshEntry entry;
    visitMeshEntry(FieldReader(r, {kMeshes, version}), entry);
    checkEntry(r, entry, pack.scene.materials.size(), geometryBytes, end);
    end = entry.offset + entry.sizeBytes;
    vertices += entry.vertices;
    triangles += entry.triangles;
    if (vertices > kMaxVertices || triangles > kMaxTriangles)
      r.fail("geometry is too large", "at most 2^28 vertices and triangles in all meshes",
             fmt::format("{} vertices and {} triangles", vertices, triangles));
    entries.push_back({entry, r});
    pack.geometry.push_back({geometryOffset + entry.offset, entry.sizeBytes});
    pack.compression.emplace_back(entry.isEdgebreaker == 1 ? "edgebreaker" : "sequential");
  }
  r.end();
  return nullptr;
} catch (...) {
  return std::current_exception();
}

}  // namespace

void readMeshes(ByteReader r, std::uint32_t version, std::span<const std::byte> geometry, std::uint64_t geometryOffset,
                std::string_view where, Pack& pack) {
  std::vector<ReadEntry> entries;
  const std::exception_ptr error = readEntries(r, version, geometry.size(), geometryOffset, pack, entries);
  // An error of a mesh precedes those of the table behind it.
  if (!pack.textures.empty() && pack.textures.size() != entries.size() && !error)
    r.fail(fmt::format("number of entries of section {}", kTextureCoordinates),
           fmt::format("{}, the number of meshes", entries.size()), fmt::format("{}", pack.textures.size()));
  pack.scene.meshes = decodeMeshes(entries, pack.textures, version, geometry, where);
  if (error) std::rethrow_exception(error);
}

void readSourceMap(ByteReader r, std::vector<Mesh>& meshes) {
  for (Mesh& mesh : meshes) {
    const auto read = [&](std::size_t count, std::vector<std::uint32_t>& list) {
      if (count > r.left() / 4)
        r.fail(fmt::format("map of mesh '{}' ends early", mesh.name), fmt::format("{} more numbers", count),
               fmt::format("{} bytes", r.left()));
      list.resize(count);
      for (std::uint32_t& number : list) number = r.u32();
    };
    read(mesh.positions.size(), mesh.sourceVertices);
    read(mesh.triangles.size(), mesh.sourceFaces);
  }
  r.end();
}

}  // namespace malus::pack
