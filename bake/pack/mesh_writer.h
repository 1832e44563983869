// The geometry of a scene pack, encoded: one grid for all meshes, every mesh proved by decoding, and what an older pack
// has already encoded taken from there.
//
// A mesh is taken from an older pack where the hash of all that the encoder would be given is the same: positions,
// normals and triangles as floats, grid, bits, and the map to the source where it is kept. One codec version makes
// equal bytes of equal inputs, so the result is bit by bit what encoding anew would give; it is up to the caller that
// the older pack was made by the same versions.
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
  std::vector<std::byte> table;     // contents of MESH
  std::vector<std::byte> geometry;  // of GEOM
  std::vector<std::byte> map;       // of SMAP; empty unless asked for
  Encodings encodings;              // of ENCD
  std::vector<MeshCompression> report;
  std::vector<std::string> warnings;
  std::string whyAll;
};

// Throws Error that names the mesh.
EncodedMeshes encodeMeshes(const Scene& scene, const WriteSettings& settings, const OlderPack* older);

}  // namespace malus::pack
