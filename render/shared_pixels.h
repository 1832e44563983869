// Memory of a GPU that two Vulkan devices of one process use: the display allocates and exports it, a renderer writes
// images to it, so that they stay on the device.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

namespace malus::render {

struct SharedPixels {
  // Of VkPhysicalDeviceIDProperties: devices with the same two values can share memory.
  std::array<std::uint8_t, 16> deviceUUID{}, driverUUID{};
  std::uint64_t bufferBytes = 0;
  std::uint64_t allocationBytes = 0;
  std::uint32_t memoryType = 0;
  bool isDedicated = false;  // allocated for one buffer
  // Exports the memory as VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT. The caller owns the file descriptor. The memory
  // must exist. Throws Error.
  std::function<int()> exportMemory;
};

}  // namespace malus::render
