// Statistics of a driver's compiler about the ray-tracing pipeline of a method, per shader: registers, spills, code
// size and a static estimate of cost. None is a measured time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/scene.h"
#include "render/scene/vulkan_path.h"

namespace malus::vulkan {

class Device;

// One shader. Numbers that a driver does not report are empty.
struct StageStatistics {
  std::string stage;  // "ray generation", "miss: environment", "closest hit: paint", "traversal"
  std::map<std::string, std::uint64_t> values;  // all of the driver's, by its names, except hashes

  // Those of RADV.
  std::optional<std::uint64_t> vectorRegisters, scalarRegisters;                // per lane, per wave
  std::optional<std::uint64_t> spilledVectorRegisters, spilledScalarRegisters;  // registers moved to memory
  std::optional<std::uint64_t> ldsBytes, codeBytes, scratchBytes;               // LDS: memory shared by a workgroup
  std::optional<std::uint64_t> instructions;
  std::optional<std::uint64_t> latency;            // estimated cycles from start to end of one wave
  std::optional<std::uint64_t> inverseThroughput;  // estimated cycles that one wave keeps the others from running
  std::optional<std::uint64_t> wavesPerSimd;       // largest number in flight at once
};

struct PipelineStatistics {
  std::string family;          // of a null device, such as "navi21"; otherwise empty
  std::string device, driver;  // "AMD Radeon ...", "radv Mesa 25.0.7"
  std::string method;
  std::size_t payloadBytes = 0;                          // of a ray's payload
  std::vector<StageStatistics> stages;                   // in the order of stageSources(), then the traversal
  std::map<std::string, std::uint32_t> groupStackBytes;  // by stage: kept across its traces
};

// Compiles the methods' pipelines for the effects of a scene, without running them. depth: most specular interactions.
// Throws Error: an unknown method, a failed compilation.
std::vector<PipelineStatistics> pipelineStatistics(const Device& device, const pack::Scene& scene,
                                                   const std::vector<std::string>& methods, std::uint32_t depth,
                                                   render::VulkanPath path = render::VulkanPath::automatic);

// The same on a device of this machine (wanted: as for Device); empty if its driver reports no statistics. Throws
// Error.
std::vector<PipelineStatistics> deviceStatistics(const pack::Scene& scene, const std::vector<std::string>& methods,
                                                 std::uint32_t depth, const std::string& wanted,
                                                 render::VulkanPath path = render::VulkanPath::automatic);

// {family, device, driver, method, payloadBytes, stages: [{stage, registers: {vector, scalar},
// spills: {vector, scalar}, lds, codeSize, scratch, instructions, latency, inverseThroughput, wavesPerSimd,
// values: {by the driver's names}}], stackBytes: {stage: bytes}}; null: not reported by the driver.
nlohmann::json toJson(const PipelineStatistics& statistics);
// The inverse of toJson(). Throws nlohmann::json::exception for other JSON.
PipelineStatistics statisticsFromJson(const nlohmann::json& json);

}  // namespace malus::vulkan
