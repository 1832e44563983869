#include "bake/pack/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

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
compress::TriangleMesh decodeGeometry(const MeshEntry& entry, std::uint32_t version, std::span<const std::byte> bytes,
                                      std::string_view where) {
  const std::string location = fmt::format("{}, mesh '{}'", where, entry.name);
  const compress::Limits limits{entry.vertices, entry.triangles};
  if (version == 1) return compress::decodeFloats(bytes, limits, location);
  return compress::decode(bytes, limits, {entry.gridOrigin, entry.gridStep, compress::kMaxPositionBits}, location);
}

Mesh decodeMesh(const ByteReader& r, const MeshEntry& entry, std::uint32_t version, std::span<const std::byte> bytes,
                std::string_view where) {
  compress::TriangleMesh decoded = decodeGeometry(entry, version, bytes, where);
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
  return mesh;
}

}  // namespace

void readMeshes(ByteReader r, std::uint32_t version, std::span<const std::byte> geometry, std::uint64_t geometryOffset,
                std::string_view where, Pack& pack) {
  FieldSizes sizes({kMeshes, version});
  const MeshEntry any{};
  visitMeshEntry(sizes, any);
  const std::uint32_t count = r.count(sizes.bytes(), kMaxMeshes, "number of meshes");
  if (count == 0) r.fail("number of meshes", "at least 1", "0");
  std::uint64_t vertices = 0, triangles = 0, end = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    MeshEntry entry;
    visitMeshEntry(FieldReader(r, {kMeshes, version}), entry);
    checkEntry(r, entry, pack.scene.materials.size(), geometry.size(), end);
    end = entry.offset + entry.sizeBytes;
    vertices += entry.vertices;
    triangles += entry.triangles;
    if (vertices > kMaxVertices || triangles > kMaxTriangles)
      r.fail("geometry is too large", "at most 2^28 vertices and triangles in all meshes",
             fmt::format("{} vertices and {} triangles", vertices, triangles));
    const auto bytes =
        geometry.subspan(static_cast<std::size_t>(entry.offset), static_cast<std::size_t>(entry.sizeBytes));
    pack.scene.meshes.push_back(decodeMesh(r, entry, version, bytes, where));
    pack.geometry.push_back({geometryOffset + entry.offset, entry.sizeBytes});
    pack.compression.emplace_back(entry.isEdgebreaker == 1 ? "edgebreaker" : "sequential");
  }
  r.end();
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
