#include "bake/pack/mesh_writer.h"

#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bake/pack/encodings_section.h"
#include "bake/pack/field_io.h"
#include "bake/pack/format.h"
#include "bake/pack/instances.h"
#include "bake/pack/record_fields.h"
#include "bake/pack/texture_coordinates.h"
#include "meshprep/base/error.h"
#include "meshprep/compress/bounds.h"
#include "meshprep/compress/rounding.h"

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

// Reason for reusing no mesh of the previous pack if the grids of all meshes changed; else empty.
std::string gridChange(const Scene& before, const Scene& after, std::uint32_t bitsBefore, std::uint32_t bitsAfter) {
  if (before.origin != after.origin)
    return fmt::format("the grids moved: the scene's origin was ({:g}, {:g}, {:g}), now ({:g}, {:g}, {:g})",
                       before.origin.x, before.origin.y, before.origin.z, after.origin.x, after.origin.y,
                       after.origin.z);
  if (bitsBefore != bitsAfter) return fmt::format("positions have {} bits instead of {}", bitsAfter, bitsBefore);
  return {};
}

// Encodes a mesh and fills its encoding and its report.
compress::Encoded encodeMesh(const Mesh& mesh, const compress::RoundedMesh& rounded,
                             const compress::RoundedTextures& textures, const compress::Settings& codec,
                             MeshEncoding& encoding, MeshCompression& report) {
  compress::Encoded encoded;
  try {
    encoded = compress::encode({mesh.positions, mesh.normals, mesh.triangles}, rounded.positions, codec, textures);
  } catch (const Error& error) {
    throw Error(fmt::format("mesh '{}'", mesh.name), error.what());
  }
  encoding.positionBits = static_cast<std::uint32_t>(codec.grid.positionBits);
  encoding.normalBits = mesh.normals.empty() ? 0u : static_cast<std::uint32_t>(codec.normalBits);
  encoding.deviation = encoded.deviation;
  encoding.sequentialReason = encoded.sequentialReason;
  report.method = encoded.method;
  report.encodeMs = encoded.encodeMs;
  report.decodeMs = encoded.decodeMs;
  return encoded;
}

// Per mesh. A map that scales lengths by factors within 1:c changes the angle of two normals by at most a factor of c.
std::vector<compress::Magnification> magnifications(const Scene& scene) {
  std::vector<compress::Magnification> result(scene.meshes.size());
  for (const Instance& instance : scene.instances) {
    const Stretch stretch = measureStretch(instance.linear);
    compress::Magnification& m = result[instance.mesh];
    m.isPlaced = true;
    m.smallest = std::min(m.smallest, stretch.smallest);
    m.largest = std::max(m.largest, stretch.largest);
    m.angle = std::max(m.angle, stretch.condition());
  }
  return result;
}

// Rounds the texture attributes of a mesh and fills their encoding.
compress::RoundedTextures roundTextures(const Scene& scene, const Mesh& mesh, const compress::Bounds& bounds,
                                        const std::string& where, TextureEncoding& encoding) {
  if (!mesh.hasTextureAttributes()) return {};
  const compress::TextureView view = textureView(mesh);
  encoding.texels = textureTexels(scene, mesh);
  compress::RoundedTextures textures = compress::roundTextures(view, encoding.texels, bounds, where);
  encoding.grids = textures.grids;
  encoding.deviation = compress::measureTextures(view, textures, encoding.texels);
  return textures;
}

std::vector<compress::MeshView> viewMeshes(const Scene& scene, std::span<const compress::Magnification> magnified) {
  std::vector<compress::MeshView> views;
  for (const Mesh& mesh : scene.meshes) {
    views.emplace_back(mesh.positions, mesh.normals, mesh.triangles);
    views.back().magnification = magnified[views.size() - 1];
  }
  return views;
}

}  // namespace

EncodedMeshes encodeMeshes(const Scene& scene, const WriteSettings& settings, const PreviousPack* previous) {
  // Round the meshes.
  const std::vector<compress::Magnification> magnified = magnifications(scene);
  const std::vector<compress::RoundedMesh> rounded = compress::roundMeshes(
      viewMeshes(scene, magnified), settings.bounds, compress::Precision::floats, settings.inspection);
  EncodedMeshes all;
  const ReusableMeshes reusable(previous);

  // Encode or reuse each mesh.
  ByteWriter table, geometry, map;
  table.u32(static_cast<std::uint32_t>(scene.meshes.size()));
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const Mesh& mesh = scene.meshes[i];
    const compress::Settings codec{rounded[i].grid, rounded[i].normalBits,
                                   compress::kLeastFloatCross / (magnified[i].smallest * magnified[i].smallest)};
    MeshCompression report;
    MeshEncoding encoding;
    compress::Encoded encoded;
    Result result;
    const std::string where = fmt::format("mesh '{}'", mesh.name);
    TextureEncoding& texture = all.textures.emplace_back();
    const compress::RoundedTextures textures = roundTextures(scene, mesh, settings.bounds, where, texture);
    const std::uint64_t hash = inputHash(mesh, rounded[i], textures, settings.keepMap);
    if (const auto at = reusable.find(hash, mesh, settings.keepMap)) {
      result = reusable.take(*at, encoding, report);
    } else {
      encoded = encodeMesh(mesh, rounded[i], textures, codec, encoding, report);
      encoding.inputHash = hash;
      result = {encoded.bytes, mesh.positions.size(), mesh.triangles.size(), {}, {}};
      if (settings.keepMap) {
        result.sourceVertices = composed(encoded.sourceVertices, mesh.sourceVertices);
        result.sourceFaces = composed(encoded.sourceTriangles, mesh.sourceFaces);
      }
    }
    const bool glass = mesh.material < scene.materials.size() && hasInside(scene.materials[mesh.material].kind);
    const auto warn = [&](std::vector<std::string> warnings) {
      all.warnings.insert(all.warnings.end(), warnings.begin(), warnings.end());
    };
    warn(compress::checkBounds(compress::deviationAfter(magnified[i], encoding.deviation), codec, settings.bounds,
                               glass, where));
    warn(compress::checkTextures(texture.deviation, texture.grids, settings.bounds, where));

    // Write its entry, its bytes and its map.
    geometry.padTo(kAlignment);
    const MeshEntry entry{mesh.name,
                          mesh.material,
                          (mesh.openSurface ? kOpenSurfaceFlag : 0) | (mesh.normals.empty() ? 0 : kNormalsFlag),
                          static_cast<std::uint32_t>(result.vertices),
                          static_cast<std::uint32_t>(result.triangles),
                          report.method == "edgebreaker" ? 1u : 0u,
                          geometry.size(),
                          result.bytes.size(),
                          codec.grid.origin,
                          codec.grid.step,
                          rounded[i].origin};
    visitMeshEntry(FieldWriter(table, {kMeshes, kNewestMeshes}), entry);
    geometry.raw(result.bytes);
    for (const std::uint32_t v : result.sourceVertices) map.u32(v);
    for (const std::uint32_t f : result.sourceFaces) map.u32(f);
    report.sequentialReason = encoding.sequentialReason;
    report.sizeBytes = result.bytes.size();
    report.positionBits = static_cast<int>(encoding.positionBits);
    report.normalBits = static_cast<int>(encoding.normalBits);
    report.deviation = encoding.deviation;
    report.texture = texture;
    all.report.push_back(std::move(report));
    all.encodings.meshes.push_back(std::move(encoding));
  }
  if (previous != nullptr && previous->pack->encodings.known())
    all.fullRebakeReason = gridChange(previous->pack->scene, scene, previous->pack->encodings.positionBits(),
                                      all.encodings.positionBits());
  all.table = table.take();
  all.geometry = geometry.take();
  all.map = map.take();
  return all;
}

}  // namespace malus::pack
