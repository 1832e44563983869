// A device that is lowered while an object exists (render/vulkan/capabilities.h).
#pragma once

#include <cstdlib>

namespace malus::test {

class Limits {
 public:
  // text: as for MALUS_VULKAN_LIMITS, "rayQuery=0,maxRayRecursionDepth=1". Devices made afterwards are lowered.
  explicit Limits(const char* text) { ::setenv("MALUS_VULKAN_LIMITS", text, 1); }
  ~Limits() { ::unsetenv("MALUS_VULKAN_LIMITS"); }
  Limits(const Limits&) = delete;
  Limits& operator=(const Limits&) = delete;
};

}  // namespace malus::test
