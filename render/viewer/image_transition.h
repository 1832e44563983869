// Changes of the layout of an image on the device.
#pragma once

#include <vulkan/vulkan.h>

namespace malus::viewer {

// Of a colour image with one level. before, stageBefore: the accesses that must have ended; after, stageAfter: those
// that wait for the change.
inline void transition(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to,
                       VkAccessFlags before, VkAccessFlags after, VkPipelineStageFlags stageBefore,
                       VkPipelineStageFlags stageAfter) {
  VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
  barrier.srcAccessMask = before;
  barrier.dstAccessMask = after;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCmdPipelineBarrier(commands, stageBefore, stageAfter, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

}  // namespace malus::viewer
