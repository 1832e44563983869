#include "render/viewer/device_stores.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "render/vulkan/shared_targets.h"

namespace malus::viewer {
using vulkan::check;

namespace {
// Capacities are rounded up to it, so that the sizes of the adaptive resolution share stores.
constexpr std::size_t kUnit = std::size_t{1} << 18u;
// The probe and saved images read host memory: cached memory first.
constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
}  // namespace

DeviceStore::DeviceStore(const DisplayDevice& device, std::size_t count, Kind kind)
    : device_(device), capacity_(std::max<std::size_t>(count, 64)) {
  allocate(kind);
  VkBufferDeviceAddressInfo address{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
  address.buffer = buffer_.get();
  address_ = vkGetBufferDeviceAddress(device.get(), &address);
  if (kind == Kind::shared) return;
  void* mapped = nullptr;
  check(vkMapMemory(device.get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory (pixels)");
  mapped_ = static_cast<float*>(mapped);
}

void DeviceStore::allocate(Kind kind) {
  const bool isShared = kind == Kind::shared;
  VkExternalMemoryBufferCreateInfo external{VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO};
  external.handleTypes = vulkan::kSharedHandle;
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, isShared ? &external : nullptr};
  info.size = capacity_ * sizeof(float);
  info.usage = vulkan::kSharedUsage;
  buffer_ = vulkan::create(device_.get(), vkCreateBuffer, info, vkDestroyBuffer, "vkCreateBuffer (pixels)");
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device_.get(), buffer_.get(), &needs);
  AllocationUse use;
  use.properties = isShared ? std::vector<VkMemoryPropertyFlags>{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0}
                            : std::vector<VkMemoryPropertyFlags>{
                                  kHost | VK_MEMORY_PROPERTY_HOST_CACHED_BIT | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                  kHost | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kHost};
  use.isExported = isShared;
  if (isShared && device_.sharesByDedicated()) use.dedicatedTo = buffer_.get();
  std::uint32_t memoryType = 0;
  memory_ = device_.allocate(needs, use, "pixels", &memoryType);
  check(vkBindBufferMemory(device_.get(), buffer_.get(), memory_.get(), 0), "vkBindBufferMemory (pixels)");
  if (isShared) describe(needs.size, memoryType, use.dedicatedTo != VK_NULL_HANDLE);
}

void DeviceStore::describe(VkDeviceSize allocationBytes, std::uint32_t memoryType, bool isDedicated) {
  shared_ = std::make_shared<render::SharedPixels>();
  shared_->deviceUUID = device_.capabilities().deviceUUID;
  shared_->driverUUID = device_.capabilities().driverUUID;
  shared_->bufferBytes = capacity_ * sizeof(float);
  shared_->allocationBytes = allocationBytes;
  shared_->memoryType = memoryType;
  shared_->isDedicated = isDedicated;
  shared_->exportMemory = [this] { return device_.exportMemory(memory_.get()); };
}

void DeviceStore::recordAcquire(VkCommandBuffer commands, std::size_t count) const {
  if (!shared_ || count <= acquired_) return;
  VkBufferMemoryBarrier barrier{VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER};
  barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_EXTERNAL;
  barrier.dstQueueFamilyIndex = device_.queueFamily();
  barrier.buffer = buffer_.get();
  barrier.offset = acquired_ * sizeof(float);
  barrier.size = (count - acquired_) * sizeof(float);
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                       VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 1,
                       &barrier, 0, nullptr);
  acquired_ = count;
}

void DeviceStore::readBack(std::size_t first, std::span<float> to) const {
  DeviceStore copy(device_, to.size(), Kind::host);
  device_.submit("read pixels", [&](VkCommandBuffer commands) {
    recordAcquire(commands, first + to.size());
    const VkBufferCopy region{first * sizeof(float), 0, to.size_bytes()};
    vkCmdCopyBuffer(commands, buffer_.get(), copy.buffer(), 1, &region);
  });
  std::ranges::copy(copy.values().first(to.size()), to.begin());
}

struct DeviceStores::Pool {
  explicit Pool(const DisplayDevice& d) : device(d) {}
  const DisplayDevice& device;
  std::mutex mutex;
  std::vector<std::unique_ptr<DeviceStore>> idle;

  // The smallest idle store of the kind that is large enough and at most four times as large.
  std::unique_ptr<DeviceStore> reuse(std::size_t count, DeviceStore::Kind kind) {
    const std::scoped_lock lock(mutex);
    std::size_t best = idle.size();
    for (std::size_t i = 0; i < idle.size(); ++i)
      if ((idle[i]->shared() != nullptr) == (kind == DeviceStore::Kind::shared) && idle[i]->capacity() >= count &&
          idle[i]->capacity() <= 4 * (count + kUnit) &&
          (best == idle.size() || idle[i]->capacity() < idle[best]->capacity()))
        best = i;
    if (best == idle.size()) return nullptr;
    std::unique_ptr<DeviceStore> found = std::move(idle[best]);
    idle.erase(idle.begin() + static_cast<std::ptrdiff_t>(best));
    found->reset();
    return found;
  }
  // Keeps few idle stores: the oldest are freed. Two always stay, because the sides of a moving view need them again.
  void release(std::unique_ptr<DeviceStore> store) {
    constexpr std::size_t kLeast = 2, kMost = 6, kMostBytes = std::size_t{1} << 28u;
    const std::scoped_lock lock(mutex);
    idle.push_back(std::move(store));
    std::size_t bytes = 0;
    for (const auto& kept : idle) bytes += kept->capacity() * sizeof(float);
    while (idle.size() > kMost || (idle.size() > kLeast && bytes > kMostBytes)) {
      bytes -= idle.front()->capacity() * sizeof(float);
      idle.erase(idle.begin());
    }
  }
};

DeviceStores::DeviceStores(const DisplayDevice& device) : pool_(std::make_shared<Pool>(device)) {}
DeviceStores::~DeviceStores() = default;

std::shared_ptr<PixelStore> DeviceStores::take(std::size_t count, DeviceStore::Kind kind) {
  std::unique_ptr<DeviceStore> store = pool_->reuse(count, kind);
  if (!store) store = std::make_unique<DeviceStore>(pool_->device, (count + kUnit - 1) / kUnit * kUnit, kind);
  return {store.release(), [pool = pool_](PixelStore* released) {
            pool->release(std::unique_ptr<DeviceStore>(static_cast<DeviceStore*>(released)));
          }};
}

std::shared_ptr<PixelStore> DeviceStores::take(std::size_t count) { return take(count, DeviceStore::Kind::host); }

std::shared_ptr<PixelStore> DeviceStores::takeShared(std::size_t count) {
  return pool_->device.exportsMemory() ? take(count, DeviceStore::Kind::shared) : nullptr;
}

}  // namespace malus::viewer
