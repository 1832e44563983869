// The file of `malus prep`: a Draco file whose positions are integers, followed by the grid that gives them a length.
//
// | bytes | contents |
// |---|---|
// | n | Draco data (draco_mesh.h) |
// | 8 | `MALUSGRD` |
// | 24 | origin, three f64, metres |
// | 8 | step, f64, metres |
//
// A file with texture coordinates or tangents has `MALUSGR2`, and 7 further f64: the origin (u, v) and the step of set
// 0 and of set 1, and the bits of a tangent (texture_rounding.h).
//
// Numbers are little-endian. Position = origin + step * integer, in the coordinates of the source file. Draco's
// decoders ignore what follows their data.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

std::vector<std::byte> meshFileBytes(std::span<const std::byte> draco, const Grid& grid,
                                     const TextureGrids& textures = {});

// Decodes a file by meshFileBytes(). Throws Error (begins with `where`).
TriangleMesh decodeMeshFile(std::span<const std::byte> bytes, std::string_view where);

}  // namespace malus::compress
