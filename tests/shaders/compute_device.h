// A compute device, for tests that run a shader on arrays of numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/vulkan/instance.h"

namespace malus::test {

class ComputeDevice {
 public:
  // The device that a renderer uses by default (choosePhysicalDevice()). Throws Error if there is none.
  explicit ComputeDevice(const vulkan::Instance& instance);
  ~ComputeDevice();
  ComputeDevice(const ComputeDevice&) = delete;

  // Whether shaders can use double.
  bool hasDouble() const { return hasDouble_; }

  // Runs `groups` groups of the shader on the input (binding 0) and returns what it wrote (binding 1).
  std::vector<std::byte> run(const std::vector<std::uint32_t>& spirv, const std::vector<std::byte>& input,
                             std::size_t outputBytes, std::uint32_t groups) const;

 private:
  struct Memory;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t family_ = 0;
  bool hasDouble_ = false;
};

}  // namespace malus::test
