// The images of the window: each frame is a copy of the display's image with the panel drawn over it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "render/viewer/display_device.h"
#include "render/viewer/display_pass.h"

namespace malus::viewer {

class Swapchain {
 public:
  // device and surface must outlive the object. Throws Error: no format that can be drawn and copied to.
  Swapchain(const DisplayDevice& device, VkSurfaceKHR surface);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  // Makes images for a window of this size, unless they have it already.
  void resize(std::uint32_t width, std::uint32_t height);
  std::uint32_t width() const { return extent_.width; }
  std::uint32_t height() const { return extent_.height; }
  VkRenderPass renderPass() const { return renderPass_.get(); }
  std::uint32_t imageCount() const { return static_cast<std::uint32_t>(images_.size()); }

  // Waits for the frame before. Records, submits and presents a frame: recordImage() leaves `image` in the layout
  // TRANSFER_SRC_OPTIMAL, recordOverlay() draws within a render pass. Returns false if the window has changed: resize()
  // and draw again. Throws Error: a lost device.
  bool draw(const DisplayImageTarget& image, const std::function<void(VkCommandBuffer)>& recordImage,
            const std::function<void(VkCommandBuffer)>& recordOverlay);
  // Time of copying the image and drawing the panel by the clock of the device [ms], of the frame before the last one
  // that draw() waited for; nothing: as DisplayPass::readMs().
  std::optional<double> overlayMs() const { return overlayMs_; }
  // Waits until the device has drawn everything.
  void finish() const;

 private:
  void makeImages();
  void recordFrame(VkCommandBuffer commands, std::uint32_t index, const DisplayImageTarget& image,
                   const std::function<void(VkCommandBuffer)>& recordOverlay) const;

  const DisplayDevice& device_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_{};
  VkExtent2D extent_{};
  bool isStale_ = false;  // the window has changed
  vulkan::Owned<VkRenderPass> renderPass_;
  vulkan::Owned<VkSwapchainKHR> swapchain_;
  std::vector<VkImage> images_;
  std::vector<vulkan::Owned<VkImageView>> views_;
  std::vector<vulkan::Owned<VkFramebuffer>> framebuffers_;
  std::vector<vulkan::Owned<VkSemaphore>> drawn_;  // per image
  vulkan::Owned<VkSemaphore> acquired_;
  vulkan::Owned<VkFence> finished_;
  vulkan::Owned<VkCommandPool> pool_;
  vulkan::Timestamps timestamps_;
  bool isRecorded_ = false;
  std::optional<double> overlayMs_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;  // freed with its pool
};

}  // namespace malus::viewer
