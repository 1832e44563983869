// GLSL to SPIR-V by glslang.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "render/vulkan/variant.h"

namespace malus::vulkan {

// Text of a file by its path; empty: no such file.
using Include = std::function<std::string_view(std::string_view path)>;

// text: a shader that starts with #version. preamble: inserted after #version. name: for messages. Throws Error with
// the compiler's messages.
std::vector<std::uint32_t> compileGlsl(const std::string& text, const std::string& preamble, Stage stage,
                                       std::string_view name, const Include& include);

// "glslang 12.0.0"; part of the cache's key.
std::string glslangVersion();

}  // namespace malus::vulkan
