// The methods of rendering, by name, from the list in shaders/CMakeLists.txt.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/render_parameters.h"

namespace malus::render {

struct MethodInfo {
  std::string name;
  std::size_t payloadBytes;  // of what a ray brings back
  bool hasStokes;            // pictures have Stokes channels; of a loop where the view asks for them
  bool isIterative;          // follows the eye's path in a loop: no recursion
  std::size_t pathBytes;     // of what a loop keeps of a path: origin, direction, depth, what the eye's path carries
};

// Whether a picture of the method has Stokes channels.
bool hasStokes(const MethodInfo& method, const RenderParameters& parameters);

const std::vector<MethodInfo>& methods();
const MethodInfo& methodNamed(std::string_view name);  // throws Error for an unknown one
std::vector<std::string> methodNames();

}  // namespace malus::render
