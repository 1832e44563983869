#include "bake/pack/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::pack {

void readMeshes(ByteReader r, std::span<const std::byte> geometry, std::uint64_t geometryOffset, std::string_view where,
                Pack& pack) {
  const std::uint32_t count = r.count(40, "number of meshes");
  if (count > kMaxMeshes) r.fail("number of meshes", fmt::format("at most {}", kMaxMeshes), fmt::format("{}", count));
  if (count == 0) r.fail("number of meshes", "at least 1", "0");
  std::uint64_t vertices = 0, triangles = 0, end = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    Mesh mesh;
    mesh.name = r.text();
    mesh.material = r.u32();
    if (mesh.material >= pack.scene.materials.size())
      r.fail("material of a mesh", fmt::format("an index below {}", pack.scene.materials.size()),
             fmt::format("{}", mesh.material));
    const std::uint32_t flags = r.u32AtMost(3, "flags of a mesh");
    mesh.sheet = (flags & 1) != 0;
    const compress::Limits limits{r.u32AtMost(kMaxVertices, "vertices of a mesh"),
                                  r.u32AtMost(kMaxTriangles, "triangles of a mesh")};
    const std::uint32_t method = r.u32AtMost(1, "encoding of a mesh");
    const std::uint64_t offset = r.u64(), size = r.u64();
    // In order and apart: no byte is decoded twice, so a small file cannot claim the same mesh many times.
    if (offset % kAlignment != 0 || offset < end || offset > geometry.size() || size > geometry.size() - offset)
      r.fail(fmt::format("geometry of mesh '{}'", mesh.name),
             fmt::format("bytes from {} on within the {} of section GEOM", end, geometry.size()),
             fmt::format("offset {}, size {}", offset, size));
    end = offset + size;
    vertices += limits.vertices;
    triangles += limits.triangles;
    if (vertices > kMaxVertices || triangles > kMaxTriangles)
      r.fail("geometry is too large", "at most 2^28 vertices and triangles", "more");
    compress::TriangleMesh decoded =
        compress::decode(geometry.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(size)), limits,
                         fmt::format("{}, mesh '{}'", where, mesh.name));
    if (decoded.normals.empty() != ((flags & 2) == 0))
      r.fail(fmt::format("normals of mesh '{}'", mesh.name), "as the table says", "otherwise");
    for (const glm::vec3& p : decoded.positions)
      if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > static_cast<float>(kMaxCoordinate))
        r.fail(fmt::format("positions of mesh '{}'", mesh.name),
               fmt::format("coordinates within {:g} m of the scene's origin", kMaxCoordinate), "others");
    mesh.positions = std::move(decoded.positions);
    mesh.normals = std::move(decoded.normals);
    mesh.triangles = std::move(decoded.triangles);
    pack.geometry.push_back({geometryOffset + offset, size});
    pack.compression.emplace_back(method == 1 ? "edgebreaker" : "sequential");
    pack.scene.meshes.push_back(std::move(mesh));
  }
  r.end();
}

void readSourceMap(ByteReader r, std::vector<Mesh>& meshes) {
  for (Mesh& mesh : meshes) {
    const auto read = [&](std::size_t count, std::vector<std::uint32_t>& list) {
      if (count > r.left() / 4)
        r.fail(fmt::format("map of mesh '{}'", mesh.name), fmt::format("{} more numbers", count),
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
