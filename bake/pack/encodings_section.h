// Hash of the inputs of the encoder, and the bytes of section ENCD.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/pack/bytes.h"
#include "bake/pack/encodings.h"
#include "bake/pack/scene.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::pack {

// XXH3 of positions, normals, triangles, grid and bits, and of the map to the source if it is kept. Equal inputs give
// equal bytes with the same version of the codec.
std::uint64_t inputHash(const Mesh& mesh, const compress::Settings& settings, bool keepMap);

std::vector<std::byte> encodingBytes(const Encodings& encodings);

// Throws Error if the section does not describe this number of meshes, or a number is out of range.
Encodings readEncodings(ByteReader reader, std::size_t meshes);

}  // namespace malus::pack
