#include "render/vulkan/scene_buffers.h"

#include <span>
#include <type_traits>
#include <vector>

#include "render/vulkan/uploads.h"

namespace malus::vulkan {

namespace {

// The values of the column `usage`.
namespace usages {
constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
constexpr VkBufferUsageFlags geometry = storage | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                                        VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
}  // namespace usages

// The types of the column `element`, by their names in GLSL.
namespace elements {
using namespace gpu;  // NOLINT(google-build-using-namespace)
using glm::uvec3;

#define MALUS_ACCELERATION_STRUCTURE(number, name)
#define MALUS_PIXEL_BUFFER(number, name, element)
#define MALUS_SCENE_BUFFER(number, name, element, usage) \
  static_assert(std::is_same_v<decltype(render::RenderScene::name), std::vector<element>>);
#define MALUS_HOST_BUFFER(number, name, type, access)
#include "shaders/gpu/bindings.def"
}  // namespace elements

template <typename T>
Buffer addArray(const Device& device, Uploads& uploads, std::string_view name, const std::vector<T>& values,
                VkBufferUsageFlags usage) {
  requireBindable(device, name, values.size() * sizeof(T));
  return uploads.add(name, std::as_bytes(std::span(values)), usage);
}

VkDeviceSize totalBytes(const render::RenderScene& scene) {
  VkDeviceSize bytes = 0;
#define MALUS_ACCELERATION_STRUCTURE(number, name)
#define MALUS_PIXEL_BUFFER(number, name, element)
#define MALUS_SCENE_BUFFER(number, name, element, usage) bytes += std::span(scene.name).size_bytes();
#define MALUS_HOST_BUFFER(number, name, type, access)
#include "shaders/gpu/bindings.def"
  return bytes;
}

}  // namespace

SceneBuffers::SceneBuffers(const Device& device, const render::RenderScene& scene) {
  Uploads uploads(device, "the scene", totalBytes(scene));
#define MALUS_ACCELERATION_STRUCTURE(number, name)
#define MALUS_PIXEL_BUFFER(number, name, element)
#define MALUS_SCENE_BUFFER(number, name, element, usage) \
  name = addArray(device, uploads, #name, scene.name, usages::usage);
#define MALUS_HOST_BUFFER(number, name, type, access)
#include "shaders/gpu/bindings.def"
  uploads.finish();
}

void SceneBuffers::updateSurfaces(const Device& device, const render::RenderScene& scene) {
  const auto bytes = [](const auto&... arrays) { return (std::span(arrays).size_bytes() + ...); };
  Uploads uploads(
      device, "materials and lights",
      bytes(scene.materials, scene.extras, scene.materialMaps, scene.textureMaps, scene.lights, scene.lightShapes,
            scene.areaLights, scene.lightNodes, scene.environmentTexels, scene.environmentDistributions));
  const auto replace = [&](std::string_view name, const auto& values, Buffer& buffer) {
    buffer = addArray(device, uploads, name, values, usages::storage);
  };
  replace("materials", scene.materials, materials);
  replace("extras", scene.extras, extras);
  replace("materialMaps", scene.materialMaps, materialMaps);
  replace("textureMaps", scene.textureMaps, textureMaps);
  replace("lights", scene.lights, lights);
  replace("lightShapes", scene.lightShapes, lightShapes);
  replace("areaLights", scene.areaLights, areaLights);
  replace("lightNodes", scene.lightNodes, lightNodes);
  replace("environmentTexels", scene.environmentTexels, environmentTexels);
  replace("environmentDistributions", scene.environmentDistributions, environmentDistributions);
  uploads.finish();
}

void SceneBuffers::bind(Bindings& bindings) const {
#define MALUS_ACCELERATION_STRUCTURE(number, name)
#define MALUS_PIXEL_BUFFER(number, name, element)
#define MALUS_SCENE_BUFFER(number, name, element, usage) bindings.bind(Binding::name, name);
#define MALUS_HOST_BUFFER(number, name, type, access)
#include "shaders/gpu/bindings.def"
}

}  // namespace malus::vulkan
