#include "render/viewer/swapchain.h"

#include <algorithm>

#include "meshprep/base/error.h"
#include "render/viewer/image_transition.h"

namespace malus::viewer {
using vulkan::check;
using vulkan::create;

namespace {

constexpr std::uint64_t kForever = ~std::uint64_t{0};

// Bytes without a transfer function: the display pass and the panel write sRGB values.
VkSurfaceFormatKHR chooseFormat(VkPhysicalDevice device, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, nullptr), "vkGetPhysicalDeviceSurfaceFormatsKHR");
  std::vector<VkSurfaceFormatKHR> formats(count);
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, formats.data()),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
    for (const VkSurfaceFormatKHR& format : formats)
      if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) return format;
  throw Error("", "the display has no format of 8 bits per colour");
}

vulkan::Owned<VkRenderPass> makeRenderPass(VkDevice device, VkFormat format) {
  VkAttachmentDescription colour{};
  colour.format = format;
  colour.samples = VK_SAMPLE_COUNT_1_BIT;
  colour.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  colour.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  colour.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  colour.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  colour.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
  info.attachmentCount = 1;
  info.pAttachments = &colour;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  return create(device, vkCreateRenderPass, info, vkDestroyRenderPass, "vkCreateRenderPass (panel)");
}

}  // namespace

Swapchain::Swapchain(const DisplayDevice& device, VkSurfaceKHR surface)
    : device_(device),
      surface_(surface),
      format_(chooseFormat(device.physical(), surface)),
      renderPass_(makeRenderPass(device.get(), format_.format)),
      timestamps_(device.makeTimestamps()) {
  const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  acquired_ = create(device.get(), vkCreateSemaphore, semaphore, vkDestroySemaphore, "vkCreateSemaphore (window)");
  VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
  finished_ = create(device.get(), vkCreateFence, fence, vkDestroyFence, "vkCreateFence (window)");
  VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  pool_ = device.makeCommandPool(VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT);
  info.commandPool = pool_.get();
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device.get(), &info, &commands_), "vkAllocateCommandBuffers (window)");
}

Swapchain::~Swapchain() { finish(); }

void Swapchain::finish() const { device_.waitIdle(); }

void Swapchain::resize(std::uint32_t width, std::uint32_t height) {
  if (swapchain_ && !isStale_ && width == extent_.width && height == extent_.height) return;
  finish();
  VkSurfaceCapabilitiesKHR limits{};
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_, &limits),
        "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  extent_ = {std::clamp(width, limits.minImageExtent.width, limits.maxImageExtent.width),
             std::clamp(height, limits.minImageExtent.height, limits.maxImageExtent.height)};
  VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
  info.surface = surface_;
  info.minImageCount = std::max(2u, limits.minImageCount);
  if (limits.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, limits.maxImageCount);
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = extent_;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = limits.currentTransform;
  info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  info.clipped = VK_TRUE;
  info.oldSwapchain = swapchain_.get();
  framebuffers_.clear();
  views_.clear();
  auto next = create(device_.get(), vkCreateSwapchainKHR, info, vkDestroySwapchainKHR, "vkCreateSwapchainKHR");
  swapchain_ = std::move(next);
  makeImages();
  isStale_ = false;
}

void Swapchain::makeImages() {
  VkDevice device = device_.get();
  std::uint32_t count = 0;
  check(vkGetSwapchainImagesKHR(device, swapchain_.get(), &count, nullptr), "vkGetSwapchainImagesKHR");
  images_.resize(count);
  check(vkGetSwapchainImagesKHR(device, swapchain_.get(), &count, images_.data()), "vkGetSwapchainImagesKHR");
  drawn_.clear();
  for (const VkImage image : images_) {
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format_.format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    views_.push_back(create(device, vkCreateImageView, view, vkDestroyImageView, "vkCreateImageView (window)"));
    const VkImageView attachment = views_.back().get();
    VkFramebufferCreateInfo frame{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    frame.renderPass = renderPass_.get();
    frame.attachmentCount = 1;
    frame.pAttachments = &attachment;
    frame.width = extent_.width;
    frame.height = extent_.height;
    frame.layers = 1;
    framebuffers_.push_back(
        create(device, vkCreateFramebuffer, frame, vkDestroyFramebuffer, "vkCreateFramebuffer (window)"));
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    drawn_.push_back(create(device, vkCreateSemaphore, semaphore, vkDestroySemaphore, "vkCreateSemaphore (window)"));
  }
}

void Swapchain::recordFrame(VkCommandBuffer commands, std::uint32_t index, const DisplayImageTarget& image,
                            const std::function<void(VkCommandBuffer)>& recordOverlay) const {
  const VkImage target = images_[index];
  transition(commands, target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
             VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT);
  VkImageBlit blit{};
  blit.srcSubresource = blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  blit.srcOffsets[1] = {static_cast<std::int32_t>(image.width()), static_cast<std::int32_t>(image.height()), 1};
  blit.dstOffsets[1] = {static_cast<std::int32_t>(extent_.width), static_cast<std::int32_t>(extent_.height), 1};
  vkCmdBlitImage(commands, image.image(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_NEAREST);
  transition(commands, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
             VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
             VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT);
  VkRenderPassBeginInfo pass{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
  pass.renderPass = renderPass_.get();
  pass.framebuffer = framebuffers_[index].get();
  pass.renderArea.extent = extent_;
  vkCmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
  recordOverlay(commands);
  vkCmdEndRenderPass(commands);
}

bool Swapchain::draw(const DisplayImageTarget& image, const std::function<void(VkCommandBuffer)>& recordImage,
                     const std::function<void(VkCommandBuffer)>& recordOverlay) {
  VkDevice device = device_.get();
  const VkFence fence = finished_.get();
  check(vkWaitForFences(device, 1, &fence, VK_TRUE, kForever), "vkWaitForFences (window)");
  if (isRecorded_) overlayMs_ = timestamps_.readMs();
  std::uint32_t index = 0;
  const VkResult acquired =
      vkAcquireNextImageKHR(device, swapchain_.get(), kForever, acquired_.get(), VK_NULL_HANDLE, &index);
  isStale_ = acquired == VK_ERROR_OUT_OF_DATE_KHR || acquired == VK_SUBOPTIMAL_KHR;
  if (acquired == VK_ERROR_OUT_OF_DATE_KHR) return false;
  if (acquired != VK_SUBOPTIMAL_KHR) check(acquired, "vkAcquireNextImageKHR");
  check(vkResetFences(device, 1, &fence), "vkResetFences (window)");
  const auto queueLock = device_.lock();
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer (window)");
  recordImage(commands_);
  timestamps_.begin(commands_);
  recordFrame(commands_, index, image, recordOverlay);
  timestamps_.end(commands_);
  isRecorded_ = true;
  check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer (window)");

  const VkSemaphore wait = acquired_.get(), signal = drawn_[index].get();
  const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.waitSemaphoreCount = 1;
  submit.pWaitSemaphores = &wait;
  submit.pWaitDstStageMask = &stage;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  submit.signalSemaphoreCount = 1;
  submit.pSignalSemaphores = &signal;
  check(vkQueueSubmit(device_.queue(), 1, &submit, fence), "vkQueueSubmit (window)");
  const VkSwapchainKHR swapchain = swapchain_.get();
  VkPresentInfoKHR present{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  present.waitSemaphoreCount = 1;
  present.pWaitSemaphores = &signal;
  present.swapchainCount = 1;
  present.pSwapchains = &swapchain;
  present.pImageIndices = &index;
  const VkResult presented = vkQueuePresentKHR(device_.queue(), &present);
  if (presented == VK_ERROR_OUT_OF_DATE_KHR || presented == VK_SUBOPTIMAL_KHR)
    isStale_ = true;
  else
    check(presented, "vkQueuePresentKHR");
  return !isStale_;
}

}  // namespace malus::viewer
