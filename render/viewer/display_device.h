// The Vulkan device of the display: one queue that computes and, with a window, presents. Needs no ray tracing. If the
// environment variable MALUS_VALIDATION is set, the validation layers are on, and each of their messages is printed.
//
// It is a VkDevice beside those of the renderers, also on the same GPU, and shares memory with them: commands of a
// renderer never delay the window. On one VkDevice they would where it has one queue, such as on lavapipe, whose first
// trace compiles for seconds in the queue.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include <vulkan/vulkan.h>

#include "render/vulkan/capabilities.h"
#include "render/vulkan/owned.h"
#include "render/vulkan/timestamps.h"

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

struct AllocationUse {
  std::vector<VkMemoryPropertyFlags> properties;  // that the type must have, the best first
  bool isExported = false;                        // DisplayDevice::exportMemory()
  VkBuffer dedicatedTo = VK_NULL_HANDLE;
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
  // Use it under lock(): submit() is called by several threads.
  VkQueue queue() const { return queue_; }
  std::unique_lock<std::mutex> lock() const { return std::unique_lock(queueMutex_); }
  std::uint32_t queueFamily() const { return family_; }
  const vulkan::Capabilities& capabilities() const { return capabilities_; }
  // Of the queue; they measure nothing where it has none.
  vulkan::Timestamps makeTimestamps() const;
  const std::string& name() const { return name_; }
  bool isCpu() const { return isCpu_; }

  // Whether renderers on the same GPU can write its memory; whether this needs an allocation for each buffer.
  bool exportsMemory() const { return getMemoryFd_ != nullptr; }
  bool sharesByDedicated() const { return sharesByDedicated_; }
  // A file descriptor of the memory, which the caller owns. Throws Error.
  int exportMemory(VkDeviceMemory memory) const;

  // Memory that a resource can be in. type: is set to its type, if not null. Throws Error: none, out of memory.
  vulkan::Owned<VkDeviceMemory> allocate(const VkMemoryRequirements& needs, const AllocationUse& use,
                                         std::string_view purpose, std::uint32_t* type = nullptr) const;
  vulkan::Owned<VkCommandPool> makeCommandPool(VkCommandPoolCreateFlags flags) const;
  // Records commands and submits them, both under the lock of the queue, and waits. Their writes are visible to the
  // host. Any thread may call it. Throws Error.
  void submit(std::string_view purpose, const std::function<void(VkCommandBuffer)>& record) const;
  // Waits until the device has done everything. A lost device is not an error here.
  void waitIdle() const;

 private:
  void createDevice(bool presents);
  void findSharing();

  std::string name_;
  bool isCpu_ = false;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  std::uint32_t family_ = 0;
  vulkan::OwnedDevice device_;
  vulkan::Capabilities capabilities_;
  VkQueue queue_ = VK_NULL_HANDLE;
  mutable std::mutex queueMutex_;
  PFN_vkGetMemoryFdKHR getMemoryFd_ = nullptr;  // null: exports no memory
  bool sharesByDedicated_ = false;
};

}  // namespace malus::viewer
