// An encoded mesh with the mesh that decode() returns.
#pragma once

#include <span>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress::test {

struct RoundTrip : Encoded {
  TriangleMesh decoded;
};

inline RoundTrip decoded(Encoded encoded, const MeshView& mesh, const Settings& settings,
                         const TextureGrids& textures = {}) {
  const Limits limits{static_cast<std::uint32_t>(mesh.positions.size()),
                      static_cast<std::uint32_t>(mesh.triangles.size())};
  TriangleMesh result = decode(encoded.bytes, limits, settings.grid, "test", textures);
  return {std::move(encoded), std::move(result)};
}

inline RoundTrip roundTrip(const MeshView& mesh, const Settings& settings) {
  return decoded(encode(mesh, settings), mesh, settings);
}

}  // namespace malus::compress::test
