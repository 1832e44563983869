#include "bake/pack/encodings.h"

#include <xxhash.h>

#include <limits>
#include <memory>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace malus::pack {

namespace {

constexpr double kMaxDistance = 1e30;
constexpr std::size_t kRecordBytes = 64;  // without the letters of its text

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

std::uint64_t inputHash(const Mesh& mesh, const compress::Settings& settings, bool keepMap) {
  ByteWriter codec;
  for (int axis = 0; axis < 3; ++axis) codec.f32(settings.grid.origin[axis]);
  codec.f32(settings.grid.range);
  codec.u32(static_cast<std::uint32_t>(settings.grid.positionBits));
  codec.u32(static_cast<std::uint32_t>(settings.normalBits));
  codec.u32(keepMap ? 1 : 0);
  Hash hash;
  hash.add(codec.take());
  hash.add(mesh.positions);
  hash.add(mesh.normals);
  hash.add(mesh.triangles);
  if (keepMap) hash.add(mesh.sourceVertices), hash.add(mesh.sourceFaces);
  return hash.value();
}

std::vector<std::byte> encodingBytes(const Encodings& encodings) {
  ByteWriter w;
  w.dvec3(glm::dvec3(encodings.grid.origin));
  w.f64(static_cast<double>(encodings.grid.range));
  w.u32(static_cast<std::uint32_t>(encodings.grid.positionBits));
  w.u32(static_cast<std::uint32_t>(encodings.meshes.size()));
  for (const MeshEncoding& m : encodings.meshes) {
    w.u64(m.inputHash);
    w.u32(m.normalBits);
    w.f64(m.deviation.positionMax);
    w.f64(m.deviation.normalMaxDegrees);
    w.f64(m.deviation.tiltMaxDegrees);
    w.u32(m.deviation.tiltFace);
    w.u64(m.deviation.flipped);
    w.u64(m.deviation.newDegenerate);
    w.u32(m.deviation.degenerateFace);
    w.text(m.whySequential);
  }
  return w.take();
}

Encodings readEncodings(ByteReader r, std::size_t meshes) {
  constexpr double kFar = std::numeric_limits<float>::max();
  Encodings encodings;
  encodings.grid.origin = glm::vec3(r.dvec3Between(-kFar, kFar, "corner of the grid"));
  encodings.grid.range = static_cast<float>(r.f64Between(0, kFar, "side of the grid"));
  encodings.grid.positionBits = static_cast<int>(r.u32AtMost(compress::kMaxPositionBits, "bits of a position"));
  const std::uint32_t count = r.count(kRecordBytes, "number of encodings");
  if (count != meshes) r.fail("number of encodings", fmt::format("{}, as of meshes", meshes), fmt::format("{}", count));
  for (std::uint32_t i = 0; i < count; ++i) {
    MeshEncoding m;
    m.inputHash = r.u64();
    m.normalBits = r.u32AtMost(compress::kMaxNormalBits, "bits of a normal");
    m.deviation.positionMax = r.f64Between(0, kMaxDistance, "error of a position");
    m.deviation.normalMaxDegrees = r.f64Between(0, 180, "error of a normal");
    m.deviation.tiltMaxDegrees = r.f64Between(0, 180, "tilt of a face");
    m.deviation.tiltFace = r.u32();
    m.deviation.flipped = r.u64();
    m.deviation.newDegenerate = r.u64();
    m.deviation.degenerateFace = r.u32();
    m.whySequential = r.text();
    encodings.meshes.push_back(std::move(m));
  }
  r.end();
  return encodings;
}

}  // namespace malus::pack
