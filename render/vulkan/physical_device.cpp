#include "render/vulkan/physical_device.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::vulkan {

namespace {

constexpr const char* kInstallDriver =
    "a device with ray-tracing pipelines; install a driver, such as mesa-vulkan-drivers 24.3 or later, which can also "
    "run on the CPU, or use --backend embree";
constexpr const char* kChooseDevice =
    "a usable device from 'malus --list-devices' (--device), a newer driver, or --backend embree";

// Empty: the renderer can use the device.
std::string findProblem(const Capabilities& device) {
  if (device.apiVersion < VK_API_VERSION_1_2)
    return fmt::format("supports Vulkan {}.{}; 1.2 or later is required", VK_API_VERSION_MAJOR(device.apiVersion),
                       VK_API_VERSION_MINOR(device.apiVersion));
  for (const char* extension : requiredExtensions())
    if (!device.has(extension)) return fmt::format("missing extension {}", extension);
  if (!device.rayTracingPipeline) return "missing feature rayTracingPipeline";
  if (!device.accelerationStructure) return "missing feature accelerationStructure";
  if (!device.bufferDeviceAddress) return "missing feature bufferDeviceAddress";
  if (!device.scalarBlockLayout) return "missing feature scalarBlockLayout";
  if (!device.hasComputeQueue) return "no queue for compute work";
  return {};
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// The option or variable that asked for a device: its value, and its name for messages.
struct Request {
  std::string value;
  const char* source = "--device";
};

Request makeRequest(const std::string& wanted) {
  if (!wanted.empty()) return {wanted};
  const char* variable = std::getenv("MALUS_DEVICE");
  return {variable ? variable : "", "MALUS_DEVICE"};
}

// Null: no such device.
const PhysicalDevice* findRequested(const std::vector<PhysicalDevice>& devices, const Request& request) {
  const bool isNumber = request.value.size() < 6 && std::all_of(request.value.begin(), request.value.end(),
                                                                [](unsigned char c) { return std::isdigit(c) != 0; });
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (isNumber ? std::stoul(request.value) == i
                 : lower(devices[i].name + " " + devices[i].driver).find(lower(request.value)) != std::string::npos)
      return &devices[i];
  return nullptr;
}

const PhysicalDevice& findBest(const std::vector<PhysicalDevice>& devices) {
  return *std::min_element(devices.begin(), devices.end(), [](const PhysicalDevice& a, const PhysicalDevice& b) {
    return std::pair(!a.problem.empty(), typeRank(a.type)) < std::pair(!b.problem.empty(), typeRank(b.type));
  });
}

}  // namespace

int typeRank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    default:
      return 3;
  }
}

const std::vector<const char*>& requiredExtensions() {
  static const std::vector<const char*> kExtensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                                       VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME,
                                                       VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
  return kExtensions;
}

std::vector<PhysicalDevice> listPhysicalDevices(const Instance& instance) {
  std::vector<PhysicalDevice> result;
  for (VkPhysicalDevice handle : instance.physicalDevices()) {
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(handle, &properties);
    Capabilities capabilities = readCapabilities(handle);
    result.push_back({handle, properties.properties.deviceName,
                      fmt::format("{} {}", driver.driverName, driver.driverInfo), findProblem(capabilities),
                      properties.properties.deviceType, std::move(capabilities)});
  }
  if (result.empty()) throw Error("Vulkan", "no device found", kInstallDriver);
  return result;
}

const PhysicalDevice* findDefaultDevice(const std::vector<PhysicalDevice>& devices) {
  const Request request = makeRequest("");
  const PhysicalDevice* const found = request.value.empty() ? &findBest(devices) : findRequested(devices, request);
  return found && found->problem.empty() ? found : nullptr;
}

PhysicalDevice choosePhysicalDevice(const Instance& instance, const std::string& wanted) {
  const std::vector<PhysicalDevice> devices = listPhysicalDevices(instance);
  const Request request = makeRequest(wanted);
  const PhysicalDevice* const chosen = request.value.empty() ? &findBest(devices) : findRequested(devices, request);
  if (!chosen)
    throw Error(request.source, "no such Vulkan device", "a number or part of a name from 'malus --list-devices'",
                fmt::format("'{}'", request.value));
  if (!chosen->problem.empty())
    throw Error("Vulkan", fmt::format("device '{}' cannot be used: {}", chosen->name, chosen->problem),
                request.value.empty() ? kInstallDriver : kChooseDevice);
  return *chosen;
}

}  // namespace malus::vulkan
