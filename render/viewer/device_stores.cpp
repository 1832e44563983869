#include "render/viewer/device_stores.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace malus::viewer {
using vulkan::check;

namespace {
// Capacities are rounded up to it, so that the sizes of the adaptive resolution share stores.
constexpr std::size_t kUnit = std::size_t{1} << 18u;
}  // namespace

DeviceStore::DeviceStore(const DisplayDevice& device, std::size_t count) : capacity_(std::max<std::size_t>(count, 64)) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = capacity_ * sizeof(float);
  info.usage = VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  buffer_ = vulkan::create(device.get(), vkCreateBuffer, info, vkDestroyBuffer, "vkCreateBuffer (pixels)");
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device.get(), buffer_.get(), &needs);
  // The probe and saved images read the memory back: cached memory first.
  constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  memory_ = device.allocate(needs,
                            {kHost | VK_MEMORY_PROPERTY_HOST_CACHED_BIT | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                             kHost | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kHost},
                            "pixels");
  check(vkBindBufferMemory(device.get(), buffer_.get(), memory_.get(), 0), "vkBindBufferMemory (pixels)");
  void* mapped = nullptr;
  check(vkMapMemory(device.get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory (pixels)");
  mapped_ = static_cast<float*>(mapped);
  VkBufferDeviceAddressInfo address{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
  address.buffer = buffer_.get();
  address_ = vkGetBufferDeviceAddress(device.get(), &address);
}

struct DeviceStores::Pool {
  explicit Pool(const DisplayDevice& d) : device(d) {}
  const DisplayDevice& device;
  std::mutex mutex;
  std::vector<std::unique_ptr<DeviceStore>> idle;

  // The smallest idle store that is large enough and at most four times as large.
  std::unique_ptr<DeviceStore> reuse(std::size_t count) {
    const std::scoped_lock lock(mutex);
    std::size_t best = idle.size();
    for (std::size_t i = 0; i < idle.size(); ++i)
      if (idle[i]->capacity() >= count && idle[i]->capacity() <= 4 * (count + kUnit) &&
          (best == idle.size() || idle[i]->capacity() < idle[best]->capacity()))
        best = i;
    if (best == idle.size()) return nullptr;
    std::unique_ptr<DeviceStore> found = std::move(idle[best]);
    idle.erase(idle.begin() + static_cast<std::ptrdiff_t>(best));
    return found;
  }
  // Keeps few idle stores: the oldest is freed.
  void release(std::unique_ptr<DeviceStore> store) {
    constexpr std::size_t kMost = 6;
    const std::scoped_lock lock(mutex);
    idle.push_back(std::move(store));
    if (idle.size() > kMost) idle.erase(idle.begin());
  }
};

DeviceStores::DeviceStores(const DisplayDevice& device) : pool_(std::make_shared<Pool>(device)) {}
DeviceStores::~DeviceStores() = default;

std::shared_ptr<PixelStore> DeviceStores::take(std::size_t count) {
  std::unique_ptr<DeviceStore> store = pool_->reuse(count);
  if (!store) store = std::make_unique<DeviceStore>(pool_->device, (count + kUnit - 1) / kUnit * kUnit);
  return {store.release(), [pool = pool_](PixelStore* released) {
            pool->release(std::unique_ptr<DeviceStore>(static_cast<DeviceStore*>(released)));
          }};
}

}  // namespace malus::viewer
