// The methods of rendering, by name, from the list in shaders/CMakeLists.txt.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace malus::render {

struct MethodInfo {
  std::string name;
  std::size_t payloadBytes;  // of what a ray brings back
  bool hasStokes;            // pictures have Stokes channels
  bool isLoop;               // follows the eye's path in a loop: no recursion
};

const std::vector<MethodInfo>& methods();
const MethodInfo& methodNamed(std::string_view name);  // throws Error for an unknown one
std::vector<std::string> methodNames();

}  // namespace malus::render
