// What the methods cost on a GPU that is not here: Mesa's RADV driver compiles their pipelines for a family
// of GPUs on its null device, which runs nothing, and tells what its compiler found. The same numbers on
// every machine with the same Mesa and glslang. They are a compiler's static estimate, never a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/vulkan/pipeline_statistics.h"

namespace malus::vulkan {

// family: as RADV names it ("navi21", "navi31"). depth: most specular interactions. The driver reads the
// family when it is loaded, so a child process, this same program with the hidden subcommand of
// gpuModelMain, does the work. Throws Error: an unknown family or one without ray tracing, no radeon
// driver, a pack that cannot be read, an unknown method, a child that failed.
std::vector<PipelineStatistics> gpuModel(const std::filesystem::path& pack, const std::string& family,
                                         const std::vector<std::string>& methods, std::uint32_t depth);

// What the child does: one line of JSON on stdout, the list of what toJson() makes. Throws Error.
void gpuModelChild(const std::filesystem::path& pack, const std::vector<std::string>& methods, std::uint32_t depth);

// To be called first in main() of every program that calls gpuModel(): whether this process is the child,
// which has then done its work and shall return 0 from main().
bool gpuModelMain(int argc, char** argv);

}  // namespace malus::vulkan
