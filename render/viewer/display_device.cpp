#include "render/viewer/display_device.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "render/vulkan/physical_device.h"

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

  const float priority = 1;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  const char* const swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
  VkPhysicalDeviceVulkan12Features features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  features.bufferDeviceAddress = VK_TRUE;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = surface ? 1 : 0;
  info.ppEnabledExtensionNames = &swapchain;
  VkDevice device = VK_NULL_HANDLE;
  check(vkCreateDevice(physical_, &info, nullptr, &device), "vkCreateDevice (display)");
  device_.reset(device);
  vkGetDeviceQueue(device, family_, 0, &queue_);
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = family_;
  pool_ = vulkan::create(device, vkCreateCommandPool, pool, vkDestroyCommandPool, "vkCreateCommandPool (display)");
}

vulkan::Owned<VkDeviceMemory> DisplayDevice::allocate(const VkMemoryRequirements& needs,
                                                      const std::vector<VkMemoryPropertyFlags>& properties,
                                                      std::string_view purpose) const {
  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
  for (const VkMemoryPropertyFlags wanted : properties)
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      if ((needs.memoryTypeBits >> i & 1u) == 0 || (memory.memoryTypes[i].propertyFlags & wanted) != wanted) continue;
      VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
      VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
      flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
      info.pNext = &flags;
      info.allocationSize = needs.size;
      info.memoryTypeIndex = i;
      return vulkan::create(get(), vkAllocateMemory, info, vkFreeMemory,
                            fmt::format("vkAllocateMemory ({}, {} bytes)", purpose, needs.size));
    }
  throw Error("", fmt::format("the device has no memory for {}", purpose));
}

void DisplayDevice::submit(std::string_view purpose, const std::function<void(VkCommandBuffer)>& record) const {
  VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  info.commandPool = pool_.get();
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(get(), &info, &commands), fmt::format("vkAllocateCommandBuffers ({})", purpose));
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &begin), fmt::format("vkBeginCommandBuffer ({})", purpose));
  record(commands);
  check(vkEndCommandBuffer(commands), fmt::format("vkEndCommandBuffer ({})", purpose));
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), fmt::format("vkQueueSubmit ({})", purpose));
  check(vkQueueWaitIdle(queue_), fmt::format("vkQueueWaitIdle ({})", purpose));
  vkFreeCommandBuffers(get(), pool_.get(), 1, &commands);
}

}  // namespace malus::viewer
