#include "render/vulkan/acceleration.h"

#include "render/vulkan/check.h"

namespace malus::vulkan {

Acceleration::Acceleration(const Device& device, const render::RenderScene& scene, const Buffer& positions,
                           const Buffer& triangles)
    : device_(device) {
  // Bottom level: one opaque geometry a mesh, in the order of the meshes, so that gl_GeometryIndexEXT is the
  // index of the mesh and of its hit record.
  std::vector<VkAccelerationStructureGeometryKHR> geometries;
  std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    geometry.flags = VK_GEOMETRY_OPAQUE_BIT_KHR;
    VkAccelerationStructureGeometryTrianglesDataKHR& data = geometry.geometry.triangles;
    data = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR};
    data.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    data.vertexData.deviceAddress = positions.address() + scene.meshes[i].firstVertex * sizeof(glm::vec3);
    data.vertexStride = sizeof(glm::vec3);
    data.maxVertex = scene.meshVertices[i] - 1;
    data.indexType = VK_INDEX_TYPE_UINT32;
    data.indexData.deviceAddress = triangles.address() + scene.meshes[i].firstTriangle * sizeof(glm::uvec3);
    geometries.push_back(geometry);
    ranges.push_back({scene.meshTriangles[i], 0, 0, 0});
  }
  VkAccelerationStructureBuildGeometryInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
  info.type = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
  info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
  info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  info.geometryCount = static_cast<std::uint32_t>(geometries.size());
  info.pGeometries = geometries.data();
  bottom_ = build(info, ranges, bottomStorage_);

  // Top level: the one instance.
  VkAccelerationStructureDeviceAddressInfoKHR addressInfo{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
  addressInfo.accelerationStructure = bottom_;
  VkAccelerationStructureInstanceKHR instance{};
  instance.transform = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  instance.mask = 0xff;
  instance.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
  instance.accelerationStructureReference = device.getAccelerationStructureDeviceAddress(device.get(), &addressInfo);
  const Buffer instances = uploaded(
      device, std::as_bytes(std::span(&instance, 1)),
      VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR);
  VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
  geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  geometry.geometry.instances = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
  geometry.geometry.instances.data.deviceAddress = instances.address();
  info.type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
  info.geometryCount = 1;
  info.pGeometries = &geometry;
  top_ = build(info, {{1, 0, 0, 0}}, topStorage_);
}

Acceleration::~Acceleration() {
  if (top_) device_.destroyAccelerationStructure(device_.get(), top_, nullptr);
  if (bottom_) device_.destroyAccelerationStructure(device_.get(), bottom_, nullptr);
}

VkAccelerationStructureKHR Acceleration::build(VkAccelerationStructureBuildGeometryInfoKHR& info,
                                               const std::vector<VkAccelerationStructureBuildRangeInfoKHR>& ranges,
                                               Buffer& storage) {
  std::vector<std::uint32_t> counts;
  for (const auto& range : ranges) counts.push_back(range.primitiveCount);
  VkAccelerationStructureBuildSizesInfoKHR sizes{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
  device_.getAccelerationStructureBuildSizes(device_.get(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info,
                                             counts.data(), &sizes);
  storage = Buffer(device_, sizes.accelerationStructureSize,
                   VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                   VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  VkAccelerationStructureCreateInfoKHR create{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
  create.buffer = storage.get();
  create.size = sizes.accelerationStructureSize;
  create.type = info.type;
  VkAccelerationStructureKHR result = VK_NULL_HANDLE;
  check(device_.createAccelerationStructure(device_.get(), &create, nullptr, &result),
        "vkCreateAccelerationStructureKHR");

  const VkDeviceSize alignment = device_.scratchAlignment();
  const Buffer scratch(device_, sizes.buildScratchSize + alignment,
                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                       VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  info.dstAccelerationStructure = result;
  info.scratchData.deviceAddress = (scratch.address() + alignment - 1) / alignment * alignment;
  const VkAccelerationStructureBuildRangeInfoKHR* const first = ranges.data();
  device_.submit([&](VkCommandBuffer commands) { device_.cmdBuildAccelerationStructures(commands, 1, &info, &first); });
  return result;
}

}  // namespace malus::vulkan
