#include "render/vulkan/pipeline_cache.h"

#include <fmt/format.h>

#include "render/vulkan/cache_file.h"

namespace malus::vulkan {

namespace {

std::string deviceKey(const Device& device) {
  const Capabilities& c = device.capabilities();
  return fmt::format("{:08x} {:08x} {:08x} {:02x} {} {}\n", c.vendorID, c.deviceID, c.driverVersion,
                     fmt::join(c.pipelineCacheUUID, ""), device.physical().name, device.physical().driver);
}

}  // namespace

PipelineCache::PipelineCache(const Device& device, const std::string& pipeline)
    : device_(device),
      file_(cacheFile("pipelines", deviceKey(device) + pipeline, ".bin")),
      stored_(loadCacheFile(file_)) {
  VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  info.initialDataSize = stored_.size();
  info.pInitialData = stored_.data();
  cache_ = create(device.get(), vkCreatePipelineCache, info, vkDestroyPipelineCache, "vkCreatePipelineCache");
}

void PipelineCache::save() const {
  std::size_t size = 0;
  if (vkGetPipelineCacheData(device_.get(), get(), &size, nullptr) != VK_SUCCESS || size == 0) return;
  std::vector<std::byte> data(size);
  if (vkGetPipelineCacheData(device_.get(), get(), &size, data.data()) != VK_SUCCESS) return;
  data.resize(size);
  if (data != stored_) saveCacheFile(file_, data);
}

}  // namespace malus::vulkan
