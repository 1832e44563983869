// Estimated cost of the methods on AMD GPUs that this machine does not have: on its null device, Mesa's RADV driver
// compiles pipelines for a family of GPUs, without running them, and reports statistics of its compiler. They are equal
// on all machines with the same Mesa and glslang, and they are static estimates, not times.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/vulkan/pipeline_statistics.h"

namespace malus::vulkan {

// family: RADV's name ("navi21", "navi31"). depth: most specular interactions. The driver reads the family when it is
// loaded, so the work is done by a child process: this program with the hidden subcommand of gpuModelMain(). Throws
// Error: an unknown family or one without ray tracing, no radeon driver, an unreadable pack, an unknown method, a child
// process that failed.
std::vector<PipelineStatistics> gpuModel(const std::filesystem::path& pack, const std::string& family,
                                         const std::vector<std::string>& methods, std::uint32_t depth);

// Must be called first in main() of every program that calls gpuModel(). True: this process is the child, its work is
// done, and main() must return 0.
bool gpuModelMain(int argc, char** argv);

}  // namespace malus::vulkan
