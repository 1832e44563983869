// Encodes the geometry of a scene pack: a grid for each mesh, every mesh checked by decoding, unchanged meshes reused
// from a previous pack.
//
// A mesh is reused if the hash of the encoder's whole input is the same: positions before and after rounding, normals
// and triangles, grid, origin, bits, and the map to the source if it is kept. One version of the codec gives equal
// bytes for equal inputs, so the result is that of encoding again, bit by bit. The caller ensures that the previous
// pack is of the same versions.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bake/pack/encodings.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"

namespace malus::pack {

struct EncodedMeshes {
  std::vector<std::byte> table;           // contents of MESH
  std::vector<std::byte> geometry;        // of GEOM
  std::vector<std::byte> map;             // of SMAP; empty unless requested
  Encodings encodings;                    // of ENCD
  std::vector<TextureEncoding> textures;  // of TCRD, per mesh
  std::vector<MeshCompression> report;
  std::vector<std::string> warnings;
  std::string fullRebakeReason;
};

// Throws Error that names the mesh.
EncodedMeshes encodeMeshes(const Scene& scene, const WriteSettings& settings, const PreviousPack* previous);

}  // namespace malus::pack
