// Dear ImGui on the window: its context, and its drawing over a frame. Hides the differences between ImGui 1.86 of
// Debian 12 and 1.91 of Debian 13.
#pragma once

#include "render/viewer/display_device.h"
#include "render/viewer/glfw_window.h"
#include "render/viewer/swapchain.h"

namespace malus::viewer {

class Overlay {
 public:
  // All arguments must outlive the object; the swapchain has images. scale: of the panel. Callbacks of the window that
  // are set before are called after those of ImGui.
  Overlay(const GlfwWindow& window, VkInstance instance, const DisplayDevice& device, const Swapchain& swapchain,
          double scale);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  void beginFrame();
  void endFrame();
  void record(VkCommandBuffer commands);

 private:
  const DisplayDevice& device_;
  vulkan::Owned<VkDescriptorPool> descriptors_;
};

}  // namespace malus::viewer
