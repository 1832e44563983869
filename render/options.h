// Options that several commands have, each with one name, one check and one description.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>

#include "bake/pack/format.h"
#include "meshprep/base/image.h"
#include "meshprep/number_option.h"
#include "render/job.h"
#include "render/pack_input.h"

namespace malus::render {

// --backend, --method, --device, --threads, --vulkan-path and --embree-path
void addBackend(CLI::App& command, Backend& backend);
void addMethod(CLI::App& command, std::string& method);
// --backends: those that render by methods
void addBackends(CLI::App& command, std::vector<Backend>& backends, const char* description);
void addDevice(CLI::App& command, std::string& device, unsigned& threads);
void addPaths(CLI::App& command, VulkanPath& vulkan, EmbreePath& embree);

// --compression of .exr files
void addCompression(CLI::App& command, image::ExrCompression& compression);

// --exposure in stops; unset: the pack's.
void addExposure(CLI::App& command, std::optional<double>& exposure);

// --width, --height and --depth. Value: std::uint32_t or std::optional of it, or a std::vector of them for a command
// that renders several images.
template <class Value>
CLI::Option* addNumber(CLI::App& command, const char* name, Value& value, std::uint32_t least, std::uint32_t most,
                       const char* description) {
  CLI::Option* option =
      command.add_option(name, value, description)->transform(wholeNumberBetween(least, most))->type_name("N");
  if constexpr (std::is_same_v<Value, std::vector<std::uint32_t>>) option->delimiter(',')->type_name("N,...");
  return option;
}
template <class Value>
CLI::Option* addWidth(CLI::App& command, Value& width) {
  return addNumber(command, "--width", width, 1, pack::kMaxResolution,
                   "Image width [pixels] (default: from --height, or the pack's; malus view: 1280)");
}
template <class Value>
CLI::Option* addHeight(CLI::App& command, Value& height) {
  return addNumber(command, "--height", height, 1, pack::kMaxResolution,
                   "Image height [pixels] (default: from --width, or the pack's; malus view: 720)");
}
template <class Value>
CLI::Option* addDepth(CLI::App& command, Value& depth) {
  return addNumber(command, "--depth", depth, 0, pack::kMaxDepth,
                   "Most specular interactions along a path (default: the pack's)");
}

// --view: a camera in place of the pack's, as render/batch/camera_keys.h reads it
void addView(CLI::App& command, std::string& camera);
// --samples and --light-samples
void addSamples(CLI::App& command, std::uint32_t& samples, std::uint32_t& lightSamples);
// --frames: number of images of a command that renders several.
CLI::Option* addFrames(CLI::App& command, unsigned& frames);

// The input, and every option of JobSettings that `render` and `sweep` share.
void addJobOptions(CLI::App& command, PackInput& input, JobSettings& settings);

// Throws CLI::ValidationError that names `option` and the methods to choose from, if images of the method have no
// Stokes channels.
void requireStokes(Backend backend, std::string_view method, const std::string& option);

}  // namespace malus::render
