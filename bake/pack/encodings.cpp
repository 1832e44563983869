#include "bake/pack/encodings_section.h"

#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "bake/pack/field_io.h"
#include "bake/pack/record_fields.h"

namespace malus::pack {

namespace {

// XXH3 over parts, each with its length before it, so that no two lists of parts look alike.
class Hash {
 public:
  Hash() { XXH3_64bits_reset(state_.get()); }
  template <class T>
  void add(std::span<const T> part) {
    const std::uint64_t size = part.size_bytes();
    XXH3_64bits_update(state_.get(), &size, sizeof size);
    if (size > 0) XXH3_64bits_update(state_.get(), part.data(), part.size_bytes());
  }
  template <class T>
  void add(const std::vector<T>& part) {
    add(std::span<const T>(part));
  }
  std::uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_{XXH3_createState()};
};

}  // namespace

std::uint32_t Encodings::positionBits() const {
  std::uint32_t most = 0;
  for (const MeshEncoding& m : meshes) most = std::max(most, m.positionBits);
  return most;
}

std::uint64_t inputHash(const Mesh& mesh, const compress::RoundedMesh& rounded,
                        const compress::RoundedTextures& textures, bool keepMap) {
  ByteWriter codec;
  codec.dvec3(rounded.grid.origin);
  codec.f64(rounded.grid.step);
  codec.u32(static_cast<std::uint32_t>(rounded.grid.positionBits));
  codec.dvec3(rounded.origin);
  codec.u32(static_cast<std::uint32_t>(rounded.normalBits));
  codec.u32(keepMap ? 1 : 0);
  Hash hash;
  hash.add(codec.take());
  hash.add(mesh.positions);
  hash.add(rounded.positions);
  hash.add(mesh.normals);
  hash.add(mesh.triangles);
  if (keepMap) hash.add(mesh.sourceVertices), hash.add(mesh.sourceFaces);
  if (textures.grids.any()) {
    ByteWriter grids;
    for (const compress::CoordinateGrid& grid : textures.grids.sets)
      grids.f64(grid.origin.x), grids.f64(grid.origin.y), grids.f64(grid.step);
    grids.u32(static_cast<std::uint32_t>(textures.grids.tangentBits));
    hash.add(grids.take());
    for (const std::vector<glm::ivec2>& set : textures.coordinates) hash.add(set);
    hash.add(textures.tangents);
  }
  return hash.value();
}

std::vector<std::byte> encodingBytes(const Encodings& encodings) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(encodings.meshes.size()));
  for (const MeshEncoding& m : encodings.meshes) visitMeshEncoding(FieldWriter(w, {kEncodings, kNewestEncodings}), m);
  return w.take();
}

Encodings readEncodings(ByteReader r, std::uint32_t version, std::size_t meshes) {
  Encodings encodings;
  SharedGrid shared;
  if (version == 1) visitSharedGrid(FieldReader(r), shared);
  FieldSizes sizes({kEncodings, version});
  const MeshEncoding any{};
  visitMeshEncoding(sizes, any);
  const std::uint32_t count = r.count(sizes.bytes(), kMaxMeshes, "number of encodings");
  if (count != meshes)
    r.fail("number of encodings", fmt::format("{}, the number of meshes", meshes), fmt::format("{}", count));
  encodings.meshes.resize(count);
  for (MeshEncoding& m : encodings.meshes) {
    m.positionBits = shared.positionBits;
    visitMeshEncoding(FieldReader(r, {kEncodings, version}), m);
  }
  r.end();
  return encodings;
}

}  // namespace malus::pack
