// Images of a glTF file: files in its folder or below it, data URIs and buffer views. They are not decoded.
#pragma once

#include <filesystem>
#include <vector>

#include "meshprep/read/gltf_buffers.h"
#include "meshprep/read/gltf_document.h"
#include "meshprep/read/gltf_left_out.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {

// Returns an image per image of the document. One that cannot be found has neither file nor bytes and, if withBytes,
// leaves a note. withBytes: data URIs are decoded and buffer views copied.
std::vector<SourceImage> gltfImages(const gltf::Document& document, GltfBuffers& buffers,
                                    const std::filesystem::path& file, bool withBytes, GltfLeftOut& leftOut);

}  // namespace malus::prep
