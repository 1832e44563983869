// Encoding and deviation of the meshes of a pack, from its section ENCD. A baker reuses the meshes whose input hash is
// unchanged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "meshprep/compress/draco_mesh.h"

namespace malus::pack {

// Bytes of one mesh within a pack's file.
struct DracoData {
  std::uint64_t offset = 0;
  std::uint64_t sizeBytes = 0;
};

struct MeshEncoding {
  std::uint64_t inputHash = 0;  // of every input of the encoder
  std::uint32_t positionBits = 0;
  std::uint32_t normalBits = 0;
  compress::Deviation deviation;
  std::string sequentialReason;  // empty for edgebreaker
};

// Grids, bits and errors of the texture attributes of a mesh, from section TCRD.
struct TextureEncoding {
  compress::TextureGrids grids;
  double texels = 0;  // longer side of the image in which errors are counted
  compress::TextureDeviation deviation;
};

struct Encodings {
  std::vector<MeshEncoding> meshes;    // per mesh; empty if the pack has no section ENCD
  std::uint32_t positionBits() const;  // the largest of the meshes
  bool known() const { return !meshes.empty(); }
};

}  // namespace malus::pack
