#include "render/vulkan/timestamps.h"

#include <array>
#include <cstdint>

namespace malus::vulkan {

Timestamps::Timestamps(const Device& device)
    : Timestamps(device.get(), device.capabilities().timestampValidBits, device.capabilities().timestampPeriod) {}

Timestamps::Timestamps(VkDevice device, std::uint64_t validBits, double period)
    : device_(device), validBits_(validBits), period_(period) {
  if (validBits == 0) return;
  VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = 2;
  pool_ = create(device, vkCreateQueryPool, info, vkDestroyQueryPool, "vkCreateQueryPool");
}

void Timestamps::begin(VkCommandBuffer commands) const {
  if (!pool_) return;
  vkCmdResetQueryPool(commands, pool_.get(), 0, 2);
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, pool_.get(), 0);
}

void Timestamps::end(VkCommandBuffer commands) const {
  if (pool_) vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_.get(), 1);
}

std::optional<double> Timestamps::readMs() const {
  if (!pool_) return std::nullopt;
  std::array<std::uint64_t, 2> ticks{};
  check(vkGetQueryPoolResults(device_, pool_.get(), 0, 2, sizeof ticks, ticks.data(), sizeof ticks[0],
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
  // The counter wraps around after timestampValidBits bits.
  const std::uint64_t mask = validBits_ >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << validBits_) - 1;
  return static_cast<double>((ticks[1] - ticks[0]) & mask) * period_ * 1e-6;
}

}  // namespace malus::vulkan
