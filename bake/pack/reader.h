// Reads a scene pack. Checks every hash before anything is decoded and every count and offset before anything is
// allocated; numbers must be finite and within the bounds of the schema.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/encodings.h"
#include "bake/pack/format.h"
#include "bake/pack/scene.h"

namespace malus::pack {

struct Pack {
  std::uint32_t formatVersion = 0;
  std::vector<Section> sections;  // in file order
  std::uint64_t hash = 0;         // over the header's and the table's bytes, hence over all hashes
  Scene scene;
  std::vector<std::string> compression;   // per mesh: "edgebreaker" or "sequential"
  std::vector<DracoData> geometry;        // per mesh: the place of its bytes
  std::vector<TextureEncoding> textures;  // per mesh: grids and errors of texture attributes; empty without any
  Encodings encodings;                    // parameters and errors of the encoding; see known()
  bool hasSourceMap() const { return !scene.meshes.empty() && !scene.meshes.front().sourceVertices.empty(); }
};

// where: the name of the file, for messages. Throws Error: not a pack, older or newer than this reader, truncated, a
// hash that does not match, contents outside the schema.
Pack parse(std::span<const std::byte> bytes, std::string_view where);
Pack read(const std::filesystem::path& path);

// Hash of the geometry that the renderers see: decoded positions, normals and triangles of every mesh, its origin, the
// instances, and texture coordinates and tangents if it has any.
std::uint64_t canonicalGeometryHash(const Scene& scene);

}  // namespace malus::pack
