// glTF 2.0, as JSON (.gltf) or binary (.glb), with KHR_draco_mesh_compression, KHR_mesh_quantization and
// KHR_materials_ior, _transmission, _volume and _emissive_strength.
//
// The JSON is filtered and checked first (gltf_json.h), then read by tinygltf; both must agree on every count.
// Buffers are read here, relative to the file: data URIs, files beside or below it, the chunk of a GLB. tinygltf
// opens nothing. Every accessor is checked against its bytes before anything is allocated by it.
//
// A primitive is a part, a node with a mesh an instance of each of its primitives. The file's default scene is taken,
// or its first; without scenes, the nodes that have no parent. Skins, morph targets and animations stay in the pose
// of the file. What is left out leaves a note.
//
// Bounds, so that a few bytes cannot ask for gigabytes: B is the size of the file and its buffers.
//   triangles of all primitives   max(2 million, B / 2), and twice the bytes of a primitive's Draco data
//   vertices of all accessors     max(6 million, B)
//   instances                     65536
//   triangles of all instances    max(4 million, 16 times those of the primitives), and three times as many vertices
//
// Source: Khronos Group, "glTF 2.0 Specification", 2021, and the extensions' texts in KhronosGroup/glTF.
#pragma once

#include <filesystem>
#include <vector>

#include "meshprep/read/source_scene.h"

namespace malus::prep {

// Throws Error that names the file and the place in it ("meshes[0].primitives[1]", or a byte): no glTF 2.0, a
// required extension that is not known, a value of the wrong type, an index of something that is not there, bytes
// that are missing, a number that is not finite, a primitive without positions, a node that is its own ancestor or
// has two parents, a transform that flattens, more than the bounds.
SourceScene readGltf(const std::filesystem::path& path);

// The files that its buffers are in.
std::vector<std::filesystem::path> gltfBufferFiles(const std::filesystem::path& path);

}  // namespace malus::prep
