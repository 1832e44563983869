// The Vulkan instance. If the environment variable MALUS_VALIDATION is set, it enables the validation layers with
// synchronization validation and keeps their messages; the value "gpu" adds GPU-assisted validation.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "render/vulkan/owned.h"

namespace malus::vulkan {

class Instance {
 public:
  // threads: of lavapipe, 0 for a number by the cores of this machine; it sets LP_NUM_THREADS, which lavapipe reads
  // when the instance is created. Throws Error: no Vulkan driver; with MALUS_VALIDATION, no validation layers.
  explicit Instance(unsigned threads);
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance get() const { return instance_.get(); }
  std::vector<VkPhysicalDevice> physicalDevices() const;
  bool isValidating() const { return static_cast<bool>(messenger_); }
  // Throws Error with the first message of the validation layers, if there is one.
  void requireNoMessages() const;

 private:
  struct Messages {
    mutable std::mutex mutex;  // several threads may call Vulkan
    std::vector<std::string> texts;
  };
  static VKAPI_ATTR VkBool32 VKAPI_CALL keepMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                    VkDebugUtilsMessageTypeFlagsEXT types,
                                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages);

  Messages messages_;
  OwnedInstance instance_;
  OwnedChild<VkInstance, VkDebugUtilsMessengerEXT> messenger_;
};

}  // namespace malus::vulkan
