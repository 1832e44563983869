// Writes a scene pack. The same scene gives the same bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "bake/pack/scene.h"

namespace malus::pack {

struct WriteSettings {
  int positionBits = 20;  // of the one grid that all meshes share
  int normalBits = 12;
};

// What compression did to a mesh.
struct MeshCompression {
  std::string method;  // "edgebreaker" or "sequential"
  std::size_t sizeBytes = 0;
  float positionErrorMax = 0;  // metres
  float normalErrorMaxDegrees = 0;
};

struct Written {
  std::vector<std::byte> bytes;
  std::vector<MeshCompression> meshes;
};

// Throws Error where the scene is outside the schema's bounds or a mesh cannot be kept by the codec.
Written serialize(const Scene& scene, const WriteSettings& settings);

// Serializes, reads back, and replaces path. Throws Error and then leaves path as it was.
Written write(const std::filesystem::path& path, const Scene& scene, const WriteSettings& settings);

}  // namespace malus::pack
