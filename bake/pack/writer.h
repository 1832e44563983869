// Writes a scene pack. The same scene gives the same bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bake/pack/reader.h"
#include "bake/pack/scene.h"
#include "meshprep/compress/bounds.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::pack {

struct WriteSettings {
  compress::Bounds bounds;
  double conversionError = 0;  // metres; how far positions are off already, by rounding to float
  bool keepMap = false;        // keep the map from packed vertices and triangles to those of the source files
};

// A pack that was written before, from which meshes that are the same are taken. Its versions of baker and codec must
// be today's.
struct OlderPack {
  const Pack* pack = nullptr;
  std::span<const std::byte> bytes;  // of its whole file
};

// What compression did to a mesh.
struct MeshCompression {
  std::string method;            // "edgebreaker" or "sequential"
  std::string sequentialReason;  // empty for edgebreaker
  std::size_t sizeBytes = 0;
  int normalBits = 0;  // 0 where the mesh has no normals
  compress::Deviation deviation;
  double encodeMs = 0, decodeMs = 0;  // wall clock; 0 where it was taken from the older pack
  bool kept = false;                  // taken from the older pack
};

struct Written {
  std::vector<std::byte> bytes;
  std::vector<MeshCompression> meshes;
  compress::Grid grid;                // that all meshes share
  std::vector<std::string> warnings;  // default bounds that are not kept, one line each
  std::string whyAll;                 // why no mesh could be taken from the older pack, where the grid is the reason
};

// Throws Error where the scene is outside the schema's bounds, a mesh cannot be kept by the codec, or a bound that was
// asked for is not reached. The bytes do not depend on `older`.
Written serialize(const Scene& scene, const WriteSettings& settings, const OlderPack* older = nullptr);

// Serializes, reads back, and replaces path. Throws Error and then leaves path as it was.
Written write(const std::filesystem::path& path, const Scene& scene, const WriteSettings& settings,
              const OlderPack* older = nullptr);

}  // namespace malus::pack
