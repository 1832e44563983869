// How the meshes of a pack were encoded and how far they are off: section ENCD. It tells people what was reached, and a
// baker which meshes it need not encode again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bake/pack/bytes.h"
#include "bake/pack/scene.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::pack {

// Bytes of one mesh within a pack's file.
struct DracoData {
  std::uint64_t offset = 0;
  std::uint64_t sizeBytes = 0;
};

struct MeshEncoding {
  std::uint64_t inputHash = 0;  // of all that the encoder was given: inputHash()
  std::uint32_t normalBits = 0;
  compress::Deviation deviation;
  std::string whySequential;  // empty for edgebreaker
};

struct Encodings {
  compress::Grid grid;
  std::vector<MeshEncoding> meshes;  // one a mesh; none where nothing is known
  bool known() const { return !meshes.empty(); }
};

// XXH3 of positions, normals, triangles, grid and bits, and of the map to the source where it is kept: equal inputs
// give equal bytes from one version of the codec.
std::uint64_t inputHash(const Mesh& mesh, const compress::Settings& settings, bool keepMap);

std::vector<std::byte> encodingBytes(const Encodings& encodings);
Encodings readEncodings(ByteReader reader, std::size_t meshes);

}  // namespace malus::pack
