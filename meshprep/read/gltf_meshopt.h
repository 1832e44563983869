// Decoding of a buffer view with EXT_meshopt_compression, by meshoptimizer.
// Source: the extension's text in KhronosGroup/glTF; decoders reject corrupt data without reading beyond it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "meshprep/read/gltf_document.h"

namespace malus::prep {

// Returns the elements, `count` times `byteStride` bytes. location: the buffer view, for messages. Throws Error: an
// unknown mode or filter, a stride or count that these do not have, more elements than the bytes can contain (64 times
// their size), corrupt data.
std::vector<std::byte> decodeGltfMeshopt(std::span<const std::byte> bytes, const gltf::MeshoptCompression& compression,
                                         const std::string& location);

}  // namespace malus::prep
