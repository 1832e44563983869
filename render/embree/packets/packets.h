// Scene and tile of the packet tracers, and the memory of a thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bake/pack/format.h"
#include "render/embree/embree.h"
#include "render/embree/tile.h"
#include "render/scene/render_scene.h"

namespace malus::embree {

// Order in which hits are shaded: by kind of surface and then by material, so that the lanes of a packet do the same
// work.
struct ShadingOrder {
  explicit ShadingOrder(const render::RenderScene& scene);

  std::vector<std::uint32_t> bucketOfMesh;  // 1 + rank of its material, at 1 + mesh; bucket 0: rays that miss, at 0
  std::vector<std::uint32_t> kindOfBucket;  // gpu::SurfaceKind; unused for bucket 0
};

// Whether the processor has one of the instruction sets that packets are compiled for.
bool hasPacketInstructions();

// Most pixels of a tile: rays that are traced and shaded together.
inline constexpr std::uint32_t kPacketTileWidth = 16;
inline constexpr std::uint32_t kPacketTileHeight = 16;
inline constexpr std::size_t kBatch = kPacketTileWidth * kPacketTileHeight;

// Levels of the recursion: one per interaction, the camera's and that of a path's end.
inline constexpr std::size_t kMostLevels = pack::kMaxDepth + 2;

// Memory that one thread keeps between tiles.
struct PacketMemory {
  explicit PacketMemory(const ShadingOrder& order) : bucketEnds(order.kindOfBucket.size()) {}

  std::vector<std::uint32_t> bucketEnds;
  std::unique_ptr<void, void (*)(void*)> tracer{nullptr, nullptr};  // made by the first tile
};

struct PacketInput {
  const TileInput& tile;
  const ShadingOrder* order;
  std::span<std::uint32_t> bucketEnds;
};

struct PacketMethod {
  const char* name;
  const char* build;
  std::uint32_t effects;  // bits of shaders::Effect that are compiled in
  TileOutput (*renderTile)(const TileInput&, const ShadingOrder&, PacketMemory&);
};

}  // namespace malus::embree
