// glTF 2.0, as JSON (.gltf) or binary (.glb), with KHR_draco_mesh_compression, EXT_meshopt_compression,
// KHR_mesh_quantization, KHR_lights_punctual, EXT_mesh_gpu_instancing and KHR_materials_ior, _transmission, _volume and
// _emissive_strength.
//
// The JSON is parsed through a whitelist of keys and types (gltf_json.h) into structures (gltf_document.h). Buffers are
// data URIs, files in the folder of the glTF file or below it, or the chunk of a GLB; no other file is opened. Every
// accessor is checked against its bytes before memory is allocated for it.
//
// Each primitive is a part; each node with a mesh makes one instance of every primitive of the mesh, and each node with
// a camera or a light makes one of these (gltf_views.h). The default scene is read, or the first scene; without scenes,
// all nodes without a parent. Meshes are in their default pose: morph targets by their default weights, skins by the
// transforms of their joints (gltf_pose.h); animations are left out. EXT_mesh_gpu_instancing places a mesh once per
// instance. Whatever is left out is listed in the notes, keys and extensions that are not known included.
//
// Limits, so that a small file cannot claim gigabytes; B is the size of the file and its buffers in bytes.
//   triangles of all primitives   max(2 million, B / 2), plus twice the bytes of a primitive's Draco data
//   vertices of all accessors     max(6 million, B), with one for each vertex and morph target or skin of a pose
//   instances                     65536
//   triangles of all instances    max(4 million, 16 times those of the primitives), and three times as many vertices
//
// Source: Khronos Group, "glTF 2.0 Specification", 2021, and the extensions' texts in KhronosGroup/glTF.
#pragma once

#include <filesystem>
#include <vector>

#include "meshprep/read/source_scene.h"

namespace malus::prep {

// Invalid content is left out with a note, or an Error if `strict`: a node, mesh, primitive, accessor, buffer view,
// buffer or scene with a value of the wrong type or without a required key, whatever refers to one that is missing or
// invalid, triangles with an index out of range or a position that is not finite, a transform that is singular, a node
// that is its own ancestor, a second parent, a camera or light. Keys with a default, such as names and the values of
// materials, are left out alone. It is an Error too if nothing is left, with the first reason.
//
// Throws Error that names the file and the location in it ("meshes[0].primitives[1]", or a byte): not glTF 2.0, an
// unknown required extension, a list of the wrong type, a limit exceeded, root nodes that are unknown (gltf_nodes.h).
// withImages: see readSourceScene().
SourceScene readGltf(const std::filesystem::path& path, bool strict = false, bool withImages = false,
                     KeepTextures textures = KeepTextures::needed);

// Files that contain the buffers and images, without those that must not be opened.
std::vector<std::filesystem::path> gltfFiles(const std::filesystem::path& path);

}  // namespace malus::prep
