// Pixel memory that the display's device reads without a copy: host memory that the device sees, on the device where
// that is possible. Released stores are used again for images of at most their size.
#pragma once

#include <memory>

#include "render/viewer/display_device.h"
#include "render/viewer/pixel_store.h"

namespace malus::viewer {

class DeviceStore : public PixelStore {
 public:
  DeviceStore(const DisplayDevice& device, std::size_t count);

  std::span<float> values() override { return {mapped_, capacity_}; }
  VkBuffer buffer() const { return buffer_.get(); }
  VkDeviceAddress address() const { return address_; }
  std::size_t capacity() const { return capacity_; }

 private:
  std::size_t capacity_;
  vulkan::Owned<VkBuffer> buffer_;
  vulkan::Owned<VkDeviceMemory> memory_;
  float* mapped_ = nullptr;
  VkDeviceAddress address_ = 0;
};

class DeviceStores : public PixelStores {
 public:
  // device must outlive the object and all its stores.
  explicit DeviceStores(const DisplayDevice& device);
  ~DeviceStores() override;
  std::shared_ptr<PixelStore> take(std::size_t count) override;

 private:
  struct Pool;
  std::shared_ptr<Pool> pool_;
};

}  // namespace malus::viewer
