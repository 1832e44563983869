// Pixel memory that the display's device reads without a copy: host memory that the device sees, or memory on the
// device alone that a renderer writes. Released stores are used again for images of at most their size.
#pragma once

#include <memory>

#include "render/viewer/display_device.h"
#include "render/viewer/pixel_store.h"

namespace malus::viewer {

class DeviceStore : public PixelStore {
 public:
  enum class Kind { host, shared };
  DeviceStore(const DisplayDevice& device, std::size_t count, Kind kind);

  std::span<float> values() override { return {mapped_, mapped_ ? capacity_ : 0}; }
  std::shared_ptr<const render::SharedPixels> shared() const override { return shared_; }
  void readBack(std::size_t first, std::span<float> to) const override;
  VkBuffer buffer() const { return buffer_.get(); }
  VkDeviceAddress address() const { return address_; }
  std::size_t capacity() const { return capacity_; }

  // Records that the device may read the first `count` values, which a renderer has written and released. Commands must
  // be submitted in the order in which they are recorded.
  void recordAcquire(VkCommandBuffer commands, std::size_t count) const;
  // The store is written anew.
  void reset() { acquired_ = 0; }

 private:
  void allocate(Kind kind);
  void describe(VkDeviceSize allocationBytes, std::uint32_t memoryType, bool isDedicated);

  const DisplayDevice& device_;
  std::size_t capacity_;
  vulkan::Owned<VkDeviceMemory> memory_;
  vulkan::Owned<VkBuffer> buffer_;  // destroyed before its memory
  float* mapped_ = nullptr;
  std::shared_ptr<render::SharedPixels> shared_;
  VkDeviceAddress address_ = 0;
  mutable std::size_t acquired_ = 0;  // values; under the lock of the queue
};

class DeviceStores : public PixelStores {
 public:
  // device must outlive the object and all its stores.
  explicit DeviceStores(const DisplayDevice& device);
  ~DeviceStores() override;
  std::shared_ptr<PixelStore> take(std::size_t count) override;
  std::shared_ptr<PixelStore> takeShared(std::size_t count) override;

 private:
  struct Pool;
  std::shared_ptr<PixelStore> take(std::size_t count, DeviceStore::Kind kind);
  std::shared_ptr<Pool> pool_;
};

}  // namespace malus::viewer
