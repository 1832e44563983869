// Writes a scene pack. The same scene gives the same bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bake/pack/reader.h"
#include "bake/pack/scene.h"
#include "meshprep/compress/bounds.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/compress/rounding.h"

namespace malus::pack {

struct WriteSettings {
  compress::Bounds bounds;
  compress::Inspection inspection;  // of the rounded meshes
  bool keepMap = false;             // write the map from packed vertices and triangles to those of the source files
  // Makes the provenance from Written::warnings; empty: the scene's is written.
  std::function<std::string(const std::vector<std::string>& warnings)> provenance;
};

// A pack from which unchanged meshes are reused. It must be of the same versions of baker and codec.
struct PreviousPack {
  const Pack* pack = nullptr;
  std::span<const std::byte> bytes;  // of its whole file
};

// Result of the compression of a mesh.
struct MeshCompression {
  std::string method;            // "edgebreaker" or "sequential"
  std::string sequentialReason;  // empty for edgebreaker
  std::size_t sizeBytes = 0;
  int positionBits = 0;
  int normalBits = 0;  // 0 without normals
  compress::Deviation deviation;
  TextureEncoding texture;
  double encodeMs = 0, decodeMs = 0;  // processor time; 0 if reused
  bool reused = false;                // taken from the previous pack
};

struct Written {
  std::vector<std::byte> bytes;
  std::vector<MeshCompression> meshes;
  int positionBits = 0;               // the most of all meshes
  std::vector<std::string> warnings;  // one line per default bound that is not kept
  std::string fullRebakeReason;       // reason for reusing no mesh if all grids changed
};

// Throws Error if the scene is outside the schema's bounds, the codec cannot represent a mesh, or a bound of the
// settings is not reached. The bytes do not depend on `previous`.
Written serialize(const Scene& scene, const WriteSettings& settings, const PreviousPack* previous = nullptr);

// Serializes, reads back, and replaces the file. After an Error the file is unchanged.
Written write(const std::filesystem::path& path, const Scene& scene, const WriteSettings& settings,
              const PreviousPack* previous = nullptr);

}  // namespace malus::pack
