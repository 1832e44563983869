// Device time between two points of a command buffer.
#pragma once

#include <optional>

#include "render/vulkan/device.h"

namespace malus::vulkan {

class Timestamps {
 public:
  // device: must outlive the timestamps. Throws Error.
  explicit Timestamps(const Device& device);
  // validBits: of the queue family; 0: it has no timestamps. period: nanoseconds per tick.
  Timestamps(VkDevice device, std::uint64_t validBits, double period);

  void begin(VkCommandBuffer commands) const;
  void end(VkCommandBuffer commands) const;
  // Waits for both. Empty: the queue has no timestamps. Throws Error.
  std::optional<double> readMs() const;

 private:
  VkDevice device_;
  std::uint64_t validBits_;
  double period_;
  Owned<VkQueryPool> pool_;
};

}  // namespace malus::vulkan
