#include "render/vulkan/timestamps.h"

#include <array>
#include <cstdint>

namespace malus::vulkan {

Timestamps::Timestamps(const Device& device) : device_(device) {
  if (device.capabilities().timestampValidBits == 0) return;
  VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = 2;
  pool_ = create(device.get(), vkCreateQueryPool, info, vkDestroyQueryPool, "vkCreateQueryPool");
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
  check(vkGetQueryPoolResults(device_.get(), pool_.get(), 0, 2, sizeof ticks, ticks.data(), sizeof ticks[0],
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
  // The counter wraps around after timestampValidBits bits.
  const std::uint64_t bits = device_.capabilities().timestampValidBits;
  const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  return static_cast<double>((ticks[1] - ticks[0]) & mask) * device_.capabilities().timestampPeriod * 1e-6;
}

}  // namespace malus::vulkan
