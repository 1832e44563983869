#include "render/viewer/display_device.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "render/vulkan/physical_device.h"
#include "render/vulkan/shared_targets.h"

namespace malus::viewer {
using vulkan::check;

namespace {

bool isValidating() { return std::getenv("MALUS_VALIDATION") != nullptr; }

// Family of queues that compute, draw and present; nothing: the device has none.
std::optional<std::uint32_t> findFamily(VkPhysicalDevice device, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (std::uint32_t i = 0; i < count; ++i) {
    VkBool32 presents = VK_TRUE;
    if (surface) check(vkGetPhysicalDeviceSurfaceSupportKHR(device, i, surface, &presents), "surface support");
    if ((families[i].queueFlags & kNeeded) == kNeeded && presents) return i;
  }
  return std::nullopt;
}

bool hasSwapchains(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
  return std::ranges::any_of(extensions, [](const VkExtensionProperties& e) {
    return std::string_view(e.extensionName) == VK_KHR_SWAPCHAIN_EXTENSION_NAME;
  });
}

bool hasAddresses(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties) {
  if (properties.apiVersion < VK_API_VERSION_1_2) return false;
  VkPhysicalDeviceVulkan12Features features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceFeatures2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  all.pNext = &features;
  vkGetPhysicalDeviceFeatures2(device, &all);
  return features.bufferDeviceAddress == VK_TRUE;
}

struct Candidate {
  VkPhysicalDevice device = VK_NULL_HANDLE;
  std::uint32_t family = 0;
  std::string name;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
};

std::vector<Candidate> findCandidates(VkInstance instance, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
  std::vector<Candidate> candidates;
  for (VkPhysicalDevice device : devices) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    // Devices with ray tracing have addresses, and so do most others.
    const std::optional<std::uint32_t> family = findFamily(device, surface);
    if (family && hasAddresses(device, properties) && (!surface || hasSwapchains(device)))
      candidates.push_back({device, *family, properties.deviceName, properties.deviceType});
  }
  std::ranges::stable_sort(candidates, {}, [](const Candidate& c) { return vulkan::typeRank(c.type); });
  return candidates;
}

}  // namespace

VKAPI_ATTR VkBool32 VKAPI_CALL DisplayInstance::printMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                             VkDebugUtilsMessageTypeFlagsEXT,
                                                             const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                             void* count) {
  ++*static_cast<std::atomic<int>*>(count);
  console::error(fmt::format("validation: {}", data->pMessage));
  return VK_FALSE;
}

DisplayInstance::DisplayInstance(std::vector<const char*> extensions) {
  std::vector<const char*> layers;
  VkDebugUtilsMessengerCreateInfoEXT messages{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  messages.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messages.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messages.pfnUserCallback = printMessage;
  messages.pUserData = &messages_;
  if (isValidating()) {
    layers.push_back("VK_LAYER_KHRONOS_validation");
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "malus view";
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
  info.ppEnabledLayerNames = layers.data();
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkInstance instance = VK_NULL_HANDLE;
  check(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance (display)");
  instance_.reset(instance);
  if (!isValidating()) return;
  const auto createMessenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
  const auto destroyMessenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
  messenger_ = vulkan::create(instance, createMessenger, messages, destroyMessenger, "vkCreateDebugUtilsMessengerEXT");
}

DisplayDevice::DisplayDevice(const DisplayInstance& instance, VkSurfaceKHR surface, const std::string& wanted) {
  const std::vector<Candidate> candidates = findCandidates(instance.get(), surface);
  const char* const variable = std::getenv("MALUS_DEVICE");
  const std::string part = !wanted.empty() ? wanted : variable ? variable : "";
  const auto isWanted = [&](const Candidate& c) { return c.name.find(part) != std::string::npos; };
  auto chosen = std::ranges::find_if(candidates, isWanted);
  if (chosen == candidates.end()) chosen = candidates.begin();  // the renderer's device may not be able to present
  if (chosen == candidates.end())
    throw Error("", surface ? "no Vulkan device can present to this display" : "no Vulkan device",
                "a Vulkan driver, such as mesa-vulkan-drivers (tools/install-deps)");
  physical_ = chosen->device;
  family_ = chosen->family;
  name_ = chosen->name;
  isCpu_ = chosen->type == VK_PHYSICAL_DEVICE_TYPE_CPU;
  capabilities_ = vulkan::readCapabilities(physical_);
  createDevice(surface != VK_NULL_HANDLE);
  vkGetDeviceQueue(get(), family_, 0, &queue_);
  findSharing();
}

void DisplayDevice::createDevice(bool presents) {
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  std::vector<const char*> extensions;
  if (presents) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  if (capabilities_.has(VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME))
    extensions.push_back(VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME);
  VkPhysicalDeviceVulkan12Features features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  features.bufferDeviceAddress = VK_TRUE;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkDevice device = VK_NULL_HANDLE;
  check(vkCreateDevice(physical_, &info, nullptr, &device), "vkCreateDevice (display)");
  device_.reset(device);
}

void DisplayDevice::findSharing() {
  if (!capabilities_.has(VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME)) return;
  VkPhysicalDeviceExternalBufferInfo buffer{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_BUFFER_INFO};
  buffer.usage = vulkan::kSharedUsage;
  buffer.handleType = vulkan::kSharedHandle;
  VkExternalBufferProperties properties{VK_STRUCTURE_TYPE_EXTERNAL_BUFFER_PROPERTIES};
  vkGetPhysicalDeviceExternalBufferProperties(physical_, &buffer, &properties);
  const VkExternalMemoryFeatureFlags features = properties.externalMemoryProperties.externalMemoryFeatures;
  constexpr VkExternalMemoryFeatureFlags kNeeded =
      VK_EXTERNAL_MEMORY_FEATURE_EXPORTABLE_BIT | VK_EXTERNAL_MEMORY_FEATURE_IMPORTABLE_BIT;
  if ((features & kNeeded) != kNeeded) return;
  sharesByDedicated_ = (features & VK_EXTERNAL_MEMORY_FEATURE_DEDICATED_ONLY_BIT) != 0;
  getMemoryFd_ = reinterpret_cast<PFN_vkGetMemoryFdKHR>(vkGetDeviceProcAddr(get(), "vkGetMemoryFdKHR"));
}

vulkan::Timestamps DisplayDevice::makeTimestamps() const {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  // capabilities_ describes another family, but may be lowered.
  const std::uint64_t bits =
      std::min<std::uint64_t>(families[family_].timestampValidBits, capabilities_.timestampValidBits);
  return {get(), bits, capabilities_.timestampPeriod};
}

int DisplayDevice::exportMemory(VkDeviceMemory memory) const {
  VkMemoryGetFdInfoKHR info{VK_STRUCTURE_TYPE_MEMORY_GET_FD_INFO_KHR};
  info.memory = memory;
  info.handleType = vulkan::kSharedHandle;
  int file = -1;
  check(getMemoryFd_(get(), &info, &file), "vkGetMemoryFdKHR (pixels)");
  return file;
}

vulkan::Owned<VkDeviceMemory> DisplayDevice::allocate(const VkMemoryRequirements& needs, const AllocationUse& use,
                                                      std::string_view purpose, std::uint32_t* type) const {
  VkMemoryDedicatedAllocateInfo dedicated{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
  dedicated.buffer = use.dedicatedTo;
  VkExportMemoryAllocateInfo exported{VK_STRUCTURE_TYPE_EXPORT_MEMORY_ALLOCATE_INFO,
                                      use.dedicatedTo ? &dedicated : nullptr};
  exported.handleTypes = vulkan::kSharedHandle;
  VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, use.isExported ? &exported : nullptr};
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags};
  info.allocationSize = needs.size;
  const VkPhysicalDeviceMemoryProperties& memory = capabilities_.memory;
  for (const VkMemoryPropertyFlags wanted : use.properties)
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      if ((needs.memoryTypeBits >> i & 1u) == 0 || (memory.memoryTypes[i].propertyFlags & wanted) != wanted) continue;
      info.memoryTypeIndex = i;
      if (type) *type = i;
      return vulkan::create(get(), vkAllocateMemory, info, vkFreeMemory,
                            fmt::format("vkAllocateMemory ({}, {} bytes)", purpose, needs.size));
    }
  throw Error("", fmt::format("the device has no memory for {}", purpose));
}

vulkan::Owned<VkCommandPool> DisplayDevice::makeCommandPool(VkCommandPoolCreateFlags flags) const {
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.flags = flags;
  pool.queueFamilyIndex = family_;
  return vulkan::create(get(), vkCreateCommandPool, pool, vkDestroyCommandPool, "vkCreateCommandPool (display)");
}

void DisplayDevice::submit(std::string_view purpose, const std::function<void(VkCommandBuffer)>& record) const {
  const auto step = [&](const char* function) { return fmt::format("{} ({})", function, purpose); };
  const auto pool = makeCommandPool(VK_COMMAND_POOL_CREATE_TRANSIENT_BIT);
  VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  info.commandPool = pool.get();
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(get(), &info, &commands), step("vkAllocateCommandBuffers"));
  const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  const auto finished = vulkan::create(get(), vkCreateFence, fenceInfo, vkDestroyFence, step("vkCreateFence"));
  {
    const auto queueLock = lock();
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), step("vkBeginCommandBuffer"));
    record(commands);
    const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_MEMORY_WRITE_BIT,
                                  VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                         nullptr, 0, nullptr);
    check(vkEndCommandBuffer(commands), step("vkEndCommandBuffer"));
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    check(vkQueueSubmit(queue_, 1, &submit, finished.get()), step("vkQueueSubmit"));
  }
  const VkFence fence = finished.get();
  check(vkWaitForFences(get(), 1, &fence, VK_TRUE, ~std::uint64_t{0}), step("vkWaitForFences"));
}

void DisplayDevice::waitIdle() const {
  const auto queueLock = lock();
  vkDeviceWaitIdle(get());
}

}  // namespace malus::viewer
