// What a driver's compiler tells about the ray-tracing pipeline of a method, shader by shader: registers,
// spills, code, and its own static estimate of cost. Never a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/scene.h"

namespace malus::vulkan {

class Device;

// One shader. Numbers that a driver does not tell are empty.
struct StageStatistics {
  std::string stage;  // "ray generation", "miss: environment", "closest hit: paint", "traversal"
  std::map<std::string, std::uint64_t> values;  // all that the driver tells, by its names, but for hashes

  // Those of RADV by names that mean one thing.
  std::optional<std::uint64_t> vectorRegisters, scalarRegisters;                // a lane's, a wave's
  std::optional<std::uint64_t> spilledVectorRegisters, spilledScalarRegisters;  // registers moved to memory
  std::optional<std::uint64_t> ldsBytes, codeBytes, scratchBytes;               // LDS: memory that a workgroup shares
  std::optional<std::uint64_t> instructions;
  std::optional<std::uint64_t> latency;            // cycles from start to end of one wave, as the compiler guesses
  std::optional<std::uint64_t> inverseThroughput;  // cycles that a wave takes from the others, likewise
  std::optional<std::uint64_t> wavesPerSimd;       // at most that many in flight at once
};

struct PipelineStatistics {
  std::string family;                                    // of a null device: "navi21"; else empty
  std::string device, driver;                            // "AMD Radeon ...", "radv Mesa 25.0.7"
  std::string method;                                    //
  std::size_t payloadBytes = 0;                          // of what a ray brings back
  std::vector<StageStatistics> stages;                   // in the order of stageSources(), then the traversal
  std::map<std::string, std::uint32_t> groupStackBytes;  // of each stage: what a call keeps across its traces
};

// Compiles the methods' pipelines for what a scene calls for; runs nothing. depth: most specular
// interactions. Throws Error: an unknown method, a depth past the device's recursion limit, a failed
// compilation.
std::vector<PipelineStatistics> pipelineStatistics(const Device& device, const pack::Scene& scene,
                                                   const std::vector<std::string>& methods, std::uint32_t depth);

// The same on a real device (wanted: as in Device); empty where its driver tells nothing. Throws Error.
std::vector<PipelineStatistics> deviceStatistics(const pack::Scene& scene, const std::vector<std::string>& methods,
                                                 std::uint32_t depth, const std::string& wanted);

// {family, device, driver, method, payloadBytes, stages: [{stage, registers: {vector, scalar},
// spills: {vector, scalar}, lds, codeSize, scratch, instructions, latency, inverseThroughput, wavesPerSimd,
// values: {by the driver's names}}], stackBytes: {stage: bytes}}; null: the driver does not tell.
nlohmann::json toJson(const PipelineStatistics& statistics);
// Throws nlohmann::json::exception unless it is toJson's.
PipelineStatistics statisticsFromJson(const nlohmann::json& json);

}  // namespace malus::vulkan
