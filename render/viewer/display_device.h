// The Vulkan device of the display: one queue that computes and, with a window, presents. Needs no ray tracing. If the
// environment variable MALUS_VALIDATION is set, the validation layers are on, and each of their messages is printed.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <vulkan/vulkan.h>

#include "render/vulkan/owned.h"

namespace malus::viewer {

class DisplayInstance {
 public:
  // extensions: that a window needs. Throws Error: no Vulkan driver.
  explicit DisplayInstance(std::vector<const char*> extensions);
  DisplayInstance(const DisplayInstance&) = delete;
  DisplayInstance& operator=(const DisplayInstance&) = delete;

  VkInstance get() const { return instance_.get(); }
  // Number of messages of the validation layers so far.
  int messages() const { return messages_; }

 private:
  static VKAPI_ATTR VkBool32 VKAPI_CALL printMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                     VkDebugUtilsMessageTypeFlagsEXT types,
                                                     const VkDebugUtilsMessengerCallbackDataEXT* data, void* count);
  std::atomic<int> messages_{0};
  vulkan::OwnedInstance instance_;
  vulkan::OwnedChild<VkInstance, VkDebugUtilsMessengerEXT> messenger_;
};

class DisplayDevice {
 public:
  // surface: that the device must present to, or VK_NULL_HANDLE. wanted: part of a device's name; "": MALUS_DEVICE,
  // else the best. Throws Error: no such device.
  DisplayDevice(const DisplayInstance& instance, VkSurfaceKHR surface, const std::string& wanted);
  DisplayDevice(const DisplayDevice&) = delete;
  DisplayDevice& operator=(const DisplayDevice&) = delete;

  VkPhysicalDevice physical() const { return physical_; }
  VkDevice get() const { return device_.get(); }
  VkQueue queue() const { return queue_; }
  std::uint32_t queueFamily() const { return family_; }
  VkCommandPool commandPool() const { return pool_.get(); }
  const std::string& name() const { return name_; }
  bool isCpu() const { return isCpu_; }

  // Memory of the first type in the list of properties that a resource can be in. Throws Error: none, out of memory.
  vulkan::Owned<VkDeviceMemory> allocate(const VkMemoryRequirements& needs,
                                         const std::vector<VkMemoryPropertyFlags>& properties,
                                         std::string_view purpose) const;
  // Records commands, submits them and waits.
  void submit(std::string_view purpose, const std::function<void(VkCommandBuffer)>& record) const;

 private:
  std::string name_;
  bool isCpu_ = false;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  std::uint32_t family_ = 0;
  vulkan::OwnedDevice device_;
  VkQueue queue_ = VK_NULL_HANDLE;
  vulkan::Owned<VkCommandPool> pool_;
};

}  // namespace malus::viewer
