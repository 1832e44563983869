// The two ways in which the Vulkan renderer traces the rays of a method.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace malus::render {

// pipeline: the shaders of a ray-tracing pipeline are called at hits and misses. query: the ray generation shader
// traverses the acceleration structure itself, by ray queries, which not every device has.
enum class VulkanPath : std::uint8_t { automatic, pipeline, query };

// Payload of a ray that returns which triangle it hits (shaders/stages/hit_record.glsl).
inline constexpr std::size_t kHitRecordBytes = 16;

// On the command line and in JSON, in the order of the enumeration.
inline constexpr std::array<const char*, 3> kVulkanPathNames = {"auto", "pipeline", "query"};
constexpr const char* vulkanPathName(VulkanPath path) { return kVulkanPathNames[static_cast<std::size_t>(path)]; }

}  // namespace malus::render
