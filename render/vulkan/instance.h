// The Vulkan instance, with the validation layers where MALUS_VALIDATION is set: then every message of
// theirs is kept, and one is enough for render() to fail.
#pragma once

#include <string>
#include <vector>

#include <vulkan/vulkan.h>

namespace malus::vulkan {

class Instance {
 public:
  // threads: of lavapipe, 0 for its best. Throws Error: no Vulkan loader or driver, no validation layer
  // where it was asked for.
  explicit Instance(unsigned threads);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance get() const { return instance_; }
  std::vector<VkPhysicalDevice> physicalDevices() const;
  bool validating() const { return messenger_ != VK_NULL_HANDLE; }
  // Throws Error with the first message of the validation layers, if there was one.
  void requireNoMessages() const;

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::vector<std::string> messages_;
};

}  // namespace malus::vulkan
