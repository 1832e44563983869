// Preloaded in front of the Vulkan loader: submissions fail as if the device were lost, from number MALUS_FAIL_AT on.
#include <dlfcn.h>

#include <atomic>
#include <cstdlib>

#include <vulkan/vulkan.h>

extern "C" [[gnu::visibility("default")]] VkResult vkQueueSubmit(VkQueue queue, std::uint32_t count,
                                                                 const VkSubmitInfo* submits, VkFence fence) {
  static std::atomic<int> submissions{0};
  const char* const limit = std::getenv("MALUS_FAIL_AT");
  if (limit && submissions++ >= std::atoi(limit)) return VK_ERROR_DEVICE_LOST;
  static const auto kNext = reinterpret_cast<PFN_vkQueueSubmit>(::dlsym(RTLD_NEXT, "vkQueueSubmit"));
  return kNext(queue, count, submits, fence);
}
