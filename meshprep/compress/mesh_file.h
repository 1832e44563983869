// The file of `malus prep`: a Draco file whose positions are integers, followed by the grid that gives them a length.
//
// | bytes | contents |
// |---|---|
// | n | Draco data (draco_mesh.h) |
// | 8 | `MALUSGRD` |
// | 24 | origin, three f64, metres |
// | 8 | step, f64, metres |
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

std::vector<std::byte> meshFileBytes(std::span<const std::byte> draco, const Grid& grid);

// Decodes a file by meshFileBytes(). Throws Error (begins with `where`).
TriangleMesh decodeMeshFile(std::span<const std::byte> bytes, std::string_view where);

}  // namespace malus::compress
