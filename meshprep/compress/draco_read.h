// Draco decoding of untrusted bytes, without the conversion of the values.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include <draco/mesh/mesh.h>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Decodes bytes whose positions have this type. The result has the expected counts, attributes and valid indices of
// vertices; values may be out of range. Throws Error (begins with `where`).
void readDraco(std::span<const std::byte> bytes, const Limits& limits, draco::DataType positionType,
               const TextureGrids& textures, std::string_view where, draco::Mesh& mesh);

}  // namespace malus::compress
