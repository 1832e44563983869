// The driver's cache for one pipeline, stored in the user's cache folder (cacheFolder("pipelines")). Its file is named
// by the device, the driver and all that the pipeline is made from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "render/vulkan/device.h"

namespace malus::vulkan {

class PipelineCache {
 public:
  // device: must outlive the cache. pipeline: the shaders and the parameters of the pipeline, as bytes. Throws Error.
  PipelineCache(const Device& device, const std::string& pipeline);

  VkPipelineCache get() const { return cache_.get(); }
  // Stores what the driver compiled, unless the file has it.
  void save() const;

 private:
  const Device& device_;
  std::filesystem::path file_;
  std::vector<std::byte> stored_;
  Owned<VkPipelineCache> cache_;
};

}  // namespace malus::vulkan
