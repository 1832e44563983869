#include "bake/pack/mesh_writer.h"

#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bake/pack/encodings_section.h"
#include "bake/pack/field_io.h"
#include "bake/pack/format.h"
#include "bake/pack/record_fields.h"
#include "meshprep/base/error.h"
#include "meshprep/compress/bounds.h"

namespace malus::pack {

namespace {

// Bytes and counts of one mesh, and the map to its source.
struct Result {
  std::span<const std::byte> bytes;
  std::size_t vertices = 0, triangles = 0;
  std::vector<std::uint32_t> sourceVertices, sourceFaces;  // if the map is kept
};

// Meshes of the previous pack by the hash of the encoder's input.
class ReusableMeshes {
 public:
  explicit ReusableMeshes(const PreviousPack* previous) : previous_(previous) {
    if (previous_ == nullptr || !previous_->pack->encodings.known()) return;
    const std::vector<MeshEncoding>& meshes = previous_->pack->encodings.meshes;
    for (std::size_t i = 0; i < meshes.size(); ++i) byHash_.emplace(meshes[i].inputHash, i);
  }

  std::optional<std::size_t> find(std::uint64_t hash, const Mesh& mesh, bool keepMap) const {
    const auto found = byHash_.find(hash);
    if (found == byHash_.end()) return std::nullopt;
    const Mesh& old = previous_->pack->scene.meshes[found->second];
    const bool same = old.positions.size() == mesh.positions.size() && old.triangles.size() == mesh.triangles.size() &&
                      old.normals.size() == mesh.normals.size() && (!keepMap || !old.sourceVertices.empty());
    return same ? std::optional(found->second) : std::nullopt;
  }

  Result take(std::size_t i, MeshEncoding& encoding, MeshCompression& report) const {
    const Pack& pack = *previous_->pack;
    const Mesh& mesh = pack.scene.meshes[i];
    const DracoData& data = pack.geometry[i];
    encoding = pack.encodings.meshes[i];
    report.method = pack.compression[i];
    report.reused = true;
    return {previous_->bytes.subspan(static_cast<std::size_t>(data.offset), static_cast<std::size_t>(data.sizeBytes)),
            mesh.positions.size(), mesh.triangles.size(), mesh.sourceVertices, mesh.sourceFaces};
  }

 private:
  const PreviousPack* previous_;
  std::map<std::uint64_t, std::size_t> byHash_;
};

// Applies the mesh's map to the file, if it has one.
std::vector<std::uint32_t> composed(const std::vector<std::uint32_t>& order, const std::vector<std::uint32_t>& source) {
  if (source.empty()) return order;
  std::vector<std::uint32_t> result;
  result.reserve(order.size());
  for (const std::uint32_t i : order) result.push_back(source[i]);
  return result;
}

// Reason for reusing no mesh of the previous pack if the grid, which all meshes share, changed; else empty.
std::string gridChange(const compress::Grid& before, const compress::Grid& after) {
  if (before.origin != after.origin || before.range != after.range)
    return fmt::format(
        "the grid that all meshes share moved: its corner was ({:g}, {:g}, {:g}) and its side {:g} m, now "
        "({:g}, {:g}, {:g}) and {:g} m",
        before.origin.x, before.origin.y, before.origin.z, before.range, after.origin.x, after.origin.y, after.origin.z,
        after.range);
  if (before.positionBits != after.positionBits)
    return fmt::format("positions have {} bits instead of {}", after.positionBits, before.positionBits);
  return {};
}

}  // namespace

EncodedMeshes encodeMeshes(const Scene& scene, const WriteSettings& settings, const PreviousPack* previous) {
  // Choose the bits.
  std::vector<compress::MeshView> views;
  for (const Mesh& mesh : scene.meshes) views.emplace_back(mesh.positions, mesh.normals, mesh.triangles);
  const compress::Bits bits = compress::chooseBits(views, settings.bounds, settings.conversionError);
  EncodedMeshes all;
  all.encodings.grid = bits.grid;
  const ReusableMeshes reusable(previous);
  if (previous != nullptr && previous->pack->encodings.known())
    all.fullRebakeReason = gridChange(previous->pack->encodings.grid, bits.grid);

  // Encode or reuse each mesh.
  ByteWriter table, geometry, map;
  table.u32(static_cast<std::uint32_t>(scene.meshes.size()));
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const Mesh& mesh = scene.meshes[i];
    const std::string where = fmt::format("mesh '{}'", mesh.name);
    const compress::Settings codec{bits.grid, bits.normalBits[i]};
    const std::uint64_t hash = inputHash(mesh, codec, settings.keepMap);
    MeshCompression report;
    MeshEncoding encoding;
    compress::Encoded encoded;
    Result result;
    if (const auto at = reusable.find(hash, mesh, settings.keepMap)) {
      result = reusable.take(*at, encoding, report);
    } else {
      try {
        encoded = compress::encode(views[i], codec);
      } catch (const Error& error) {
        throw Error(where, error.what());
      }
      encoding = {hash, mesh.normals.empty() ? 0u : static_cast<std::uint32_t>(codec.normalBits), encoded.deviation,
                  encoded.sequentialReason};
      report.method = encoded.method;
      report.encodeMs = encoded.encodeMs;
      report.decodeMs = encoded.decodeMs;
      result = {encoded.bytes, encoded.decoded.positions.size(), encoded.decoded.triangles.size(), {}, {}};
      if (settings.keepMap) {
        result.sourceVertices = composed(encoded.sourceVertices, mesh.sourceVertices);
        result.sourceFaces = composed(encoded.sourceTriangles, mesh.sourceFaces);
      }
    }
    for (std::string& warning :
         compress::checkBounds(encoding.deviation, codec, settings.bounds, where, settings.conversionError))
      all.warnings.push_back(std::move(warning));

    // Write its entry, its bytes and its map.
    geometry.padTo(kAlignment);
    const MeshEntry entry{mesh.name,
                          mesh.material,
                          (mesh.openSurface ? kOpenSurfaceFlag : 0) | (mesh.normals.empty() ? 0 : kNormalsFlag),
                          static_cast<std::uint32_t>(result.vertices),
                          static_cast<std::uint32_t>(result.triangles),
                          report.method == "edgebreaker" ? 1u : 0u,
                          geometry.size(),
                          result.bytes.size()};
    visitMeshEntry(FieldWriter(table), entry);
    geometry.raw(result.bytes);
    for (const std::uint32_t v : result.sourceVertices) map.u32(v);
    for (const std::uint32_t f : result.sourceFaces) map.u32(f);
    report.sequentialReason = encoding.sequentialReason;
    report.sizeBytes = result.bytes.size();
    report.normalBits = static_cast<int>(encoding.normalBits);
    report.deviation = encoding.deviation;
    all.report.push_back(std::move(report));
    all.encodings.meshes.push_back(std::move(encoding));
  }
  all.table = table.take();
  all.geometry = geometry.take();
  all.map = map.take();
  return all;
}

}  // namespace malus::pack
