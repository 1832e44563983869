#include "render/vulkan/instance.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <thread>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::vulkan {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

// More threads than cores balance lavapipe's uneven tiles: fewer than 16 were slower on two cores. By default a value
// of the user's environment is kept.
void setLavapipeThreads(unsigned threads) {
  const unsigned number = threads > 0 ? threads : std::clamp(std::thread::hardware_concurrency(), 16u, 32u);
  ::setenv("LP_NUM_THREADS", fmt::format("{}", number).c_str(), threads > 0 ? 1 : 0);
}

void checkInstance(VkResult result) {
  if (result == VK_ERROR_LAYER_NOT_PRESENT)
    throw Error("MALUS_VALIDATION", "the validation layers are not installed",
                "package vulkan-validationlayers, or the variable unset");
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
    throw Error("Vulkan", "no driver found",
                "a Vulkan driver; install one, such as mesa-vulkan-drivers 24.3 or later, or use --backend embree");
  check(result, "vkCreateInstance");
}

template <typename Function>
Function load(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

VKAPI_ATTR VkBool32 VKAPI_CALL Instance::keepMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                     VkDebugUtilsMessageTypeFlagsEXT,
                                                     const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  const char* const id = data->pMessageIdName ? data->pMessageIdName : "no identifier";
  // Layers since 1.4 list the features that they enable for their own shaders.
  if (id == std::string_view("WARNING-GPU-Assisted-Validation")) return VK_FALSE;
  auto& messages = *static_cast<Messages*>(user);
  const std::lock_guard lock(messages.mutex);
  messages.texts.push_back(fmt::format("{}: {}", id, data->pMessage ? data->pMessage : "no text"));
  return VK_FALSE;
}

Instance::Instance(unsigned threads) {
  setLavapipeThreads(threads);
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "malus";
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  messenger.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messenger.pfnUserCallback = keepMessage;
  messenger.pUserData = &messages_;
  std::vector<VkValidationFeatureEnableEXT> enabled = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  const char* const variable = std::getenv("MALUS_VALIDATION");
  const bool byGpu = variable && variable == std::string_view("gpu");
  if (byGpu)
    enabled.insert(enabled.end(), {VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT,
                                   VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT});
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  features.enabledValidationFeatureCount = static_cast<std::uint32_t>(enabled.size());
  features.pEnabledValidationFeatures = enabled.data();
  // The core checks are those of the other mode. Layers since 1.4 warn of both at once.
  const VkValidationFeatureDisableEXT disabled = VK_VALIDATION_FEATURE_DISABLE_CORE_CHECKS_EXT;
  features.disabledValidationFeatureCount = byGpu ? 1 : 0;
  features.pDisabledValidationFeatures = &disabled;
  const char* const layers[] = {kValidationLayer};
  const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  if (variable) {
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = layers;
    info.enabledExtensionCount = 2;
    info.ppEnabledExtensionNames = extensions;
    info.pNext = &messenger;
    messenger.pNext = &features;
  }
  VkInstance instance = VK_NULL_HANDLE;
  checkInstance(vkCreateInstance(&info, nullptr, &instance));
  instance_.reset(instance);
  messenger.pNext = nullptr;
  if (variable)
    messenger_ =
        create(instance, load<PFN_vkCreateDebugUtilsMessengerEXT>(instance, "vkCreateDebugUtilsMessengerEXT"),
               messenger, load<PFN_vkDestroyDebugUtilsMessengerEXT>(instance, "vkDestroyDebugUtilsMessengerEXT"),
               "vkCreateDebugUtilsMessengerEXT");
}

std::vector<VkPhysicalDevice> Instance::physicalDevices() const {
  std::uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(get(), &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  if (count > 0) check(vkEnumeratePhysicalDevices(get(), &count, devices.data()), "vkEnumeratePhysicalDevices");
  devices.resize(count);
  return devices;
}

void Instance::requireNoMessages() const {
  const std::lock_guard lock(messages_.mutex);
  if (!messages_.texts.empty())
    throw Error("Vulkan validation",
                fmt::format("{} messages, the first: {}", messages_.texts.size(), messages_.texts.front()));
}

}  // namespace malus::vulkan
