// A device for ray tracing with one queue, and commands on that queue.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <vulkan/vulkan.h>

#include "render/vulkan/device_functions.h"
#include "render/vulkan/instance.h"
#include "render/vulkan/owned.h"
#include "render/vulkan/physical_device.h"

namespace malus::vulkan {

// Uses of a device besides tracing rays; enabled where the driver has them.
struct DeviceUse {
  bool statistics = false;     // of pipelines
  bool importsMemory = false;  // of another VkDevice, by VK_KHR_external_memory_fd
};

class Device {
 public:
  // instance: must outlive the device. wanted: as for choosePhysicalDevice(). Throws Error: no usable device, a failed
  // call.
  Device(const Instance& instance, const std::string& wanted, DeviceUse use = {});
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  VkDevice get() const { return device_.get(); }
  const DeviceFunctions& functions() const { return functions_; }
  const PhysicalDevice& physical() const { return physical_; }
  const Capabilities& capabilities() const { return physical_.capabilities; }
  bool hasStatistics() const { return functions_.getPipelineExecutableStatistics != nullptr; }
  bool importsMemory() const { return importsMemory_; }

  // Records commands, submits them and waits for their end. Their writes are visible to the host and to later
  // submissions. purpose: for messages. Calls must not overlap. Throws Error.
  void submit(std::string_view purpose, const std::function<void(VkCommandBuffer)>& record) const;

 private:
  void createDevice(DeviceUse use);

  PhysicalDevice physical_;
  bool importsMemory_ = false;
  OwnedDevice device_;
  DeviceFunctions functions_;
  VkQueue queue_ = VK_NULL_HANDLE;
  Owned<VkCommandPool> pool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;  // of every submission; freed with its pool
};

}  // namespace malus::vulkan
