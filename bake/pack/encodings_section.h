// Hash of the inputs of the encoder, and the bytes of section ENCD.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/pack/bytes.h"
#include "bake/pack/encodings.h"
#include "bake/pack/scene.h"
#include "meshprep/compress/rounding.h"

namespace malus::pack {

// XXH3 of positions before and after rounding, normals, triangles, grid, origin and bits, and of the map to the source
// if it is kept; of texture attributes too if there are any. Equal inputs give equal bytes and deviations with the same
// version of the codec.
std::uint64_t inputHash(const Mesh& mesh, const compress::RoundedMesh& rounded,
                        const compress::RoundedTextures& textures, bool keepMap);

std::vector<std::byte> encodingBytes(const Encodings& encodings);

// version: that of the section. Throws Error if the section does not describe this number of meshes, or a number is out
// of range.
Encodings readEncodings(ByteReader reader, std::uint32_t version, std::size_t meshes);

}  // namespace malus::pack
