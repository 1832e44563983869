#include "render/vulkan/acceleration.h"

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::vulkan {

namespace {

// Throws Error if a bottom-level structure cannot have the scene's meshes or triangles.
void requireCounts(const Device& device, const render::RenderScene& scene) {
  const auto require = [&](std::string_view what, std::uint64_t count, std::uint64_t limit, const char* name) {
    if (count > limit)
      throw Error(fmt::format("Vulkan device '{}'", device.physical().name),
                  fmt::format("the scene has too many {}", what),
                  fmt::format("at most {} ({}); reduce the scene, or use another device (--device) or --backend embree",
                              limit, name),
                  fmt::format("{}", count));
  };
  const Capabilities& limits = device.capabilities();
  require("meshes", scene.meshes.size(), limits.maxGeometryCount, "maxGeometryCount");
  std::uint64_t triangles = 0;
  for (const std::uint32_t count : scene.meshTriangles) triangles += count;
  require("triangles", triangles, limits.maxPrimitiveCount, "maxPrimitiveCount");
}

const char* levelName(VkAccelerationStructureTypeKHR type) {
  return type == VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR ? "top-level structure" : "bottom-level structure";
}

}  // namespace

Acceleration::Acceleration(const Device& device, const render::RenderScene& scene, const Buffer& positions,
                           const Buffer& triangles)
    : bottoms_(buildBottoms(device, scene, positions, triangles)), top_(buildTop(device, scene, bottoms_)) {}

VkDeviceSize Acceleration::bottomBytes() const {
  VkDeviceSize bytes = 0;
  for (const Level& bottom : bottoms_) bytes += bottom.storage.sizeBytes();
  return bytes;
}

std::vector<Acceleration::Level> Acceleration::buildBottoms(const Device& device, const render::RenderScene& scene,
                                                            const Buffer& positions, const Buffer& triangles) {
  requireCounts(device, scene);
  std::vector<Level> bottoms;
  for (const render::MeshRun& run : render::findMeshRuns(scene))
    bottoms.push_back(buildBottom(device, scene, run, positions, triangles));
  return bottoms;
}

// One opaque geometry per mesh, in the order of the meshes: gl_InstanceCustomIndexEXT + gl_GeometryIndexEXT is the
// index of the mesh and of its hit record.
Acceleration::Level Acceleration::buildBottom(const Device& device, const render::RenderScene& scene,
                                              const render::MeshRun& run, const Buffer& positions,
                                              const Buffer& triangles) {
  std::vector<VkAccelerationStructureGeometryKHR> geometries;
  std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
  for (std::size_t i = run.first; i < run.first + run.count; ++i) {
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
  return compact(device, build(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, geometries, ranges));
}

// An instance per run of meshes, at their origin.
Acceleration::Level Acceleration::buildTop(const Device& device, const render::RenderScene& scene,
                                           const std::vector<Level>& bottoms) {
  const std::vector<render::MeshRun> runs = render::findMeshRuns(scene);
  std::vector<VkAccelerationStructureInstanceKHR> list;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    VkAccelerationStructureDeviceAddressInfoKHR addressInfo{
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
    addressInfo.accelerationStructure = bottoms[i].structure.get();
    const glm::vec3& origin = scene.meshes[runs[i].first].origin;
    VkAccelerationStructureInstanceKHR instance{};
    instance.transform = {{{1, 0, 0, origin.x}, {0, 1, 0, origin.y}, {0, 0, 1, origin.z}}};
    instance.mask = 0xff;
    instance.instanceCustomIndex = runs[i].first & 0xffffffu;
    instance.instanceShaderBindingTableRecordOffset = runs[i].first & 0xffffffu;
    instance.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
    instance.accelerationStructureReference =
        device.functions().getAccelerationStructureDeviceAddress(device.get(), &addressInfo);
    list.push_back(instance);
  }
  const Buffer instances = upload(
      device, "instances of the scene", std::as_bytes(std::span(list)),
      VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR);
  VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
  geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  geometry.geometry.instances = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
  geometry.geometry.instances.data.deviceAddress = instances.address();
  return build(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, {geometry},
               {{static_cast<std::uint32_t>(list.size()), 0, 0, 0}});
}

Acceleration::Level Acceleration::makeLevel(const Device& device, VkAccelerationStructureTypeKHR type,
                                            VkDeviceSize bytes) {
  Level result;
  result.storage =
      Buffer(device, levelName(type), bytes,
             VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
             kDeviceMemory);
  VkAccelerationStructureCreateInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
  info.buffer = result.storage.get();
  info.size = bytes;
  info.type = type;
  result.structure = create(device.get(), device.functions().createAccelerationStructure, info,
                            device.functions().destroyAccelerationStructure,
                            fmt::format("vkCreateAccelerationStructureKHR ({})", levelName(type)));
  return result;
}

Acceleration::Level Acceleration::compact(const Device& device, Level level) {
  constexpr VkQueryType kQuery = VK_QUERY_TYPE_ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR;
  VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = kQuery;
  info.queryCount = 1;
  const Owned<VkQueryPool> pool =
      create(device.get(), vkCreateQueryPool, info, vkDestroyQueryPool, "vkCreateQueryPool (compacted size)");
  const VkAccelerationStructureKHR built = level.structure.get();
  device.submit("compacted size", [&](VkCommandBuffer commands) {
    vkCmdResetQueryPool(commands, pool.get(), 0, 1);
    device.functions().cmdWriteAccelerationStructuresProperties(commands, 1, &built, kQuery, pool.get(), 0);
  });
  VkDeviceSize bytes = 0;
  check(vkGetQueryPoolResults(device.get(), pool.get(), 0, 1, sizeof bytes, &bytes, sizeof bytes,
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults (compacted size)");
  if (bytes == 0 || bytes >= level.storage.sizeBytes()) return level;

  Level result = makeLevel(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, bytes);
  VkCopyAccelerationStructureInfoKHR copy{VK_STRUCTURE_TYPE_COPY_ACCELERATION_STRUCTURE_INFO_KHR};
  copy.src = built;
  copy.dst = result.structure.get();
  copy.mode = VK_COPY_ACCELERATION_STRUCTURE_MODE_COMPACT_KHR;
  device.submit("compaction",
                [&](VkCommandBuffer commands) { device.functions().cmdCopyAccelerationStructure(commands, &copy); });
  return result;
}

Acceleration::Level Acceleration::build(const Device& device, VkAccelerationStructureTypeKHR type,
                                        const std::vector<VkAccelerationStructureGeometryKHR>& geometries,
                                        const std::vector<VkAccelerationStructureBuildRangeInfoKHR>& ranges) {
  VkAccelerationStructureBuildGeometryInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
  info.type = type;
  info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
  if (type == VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR)
    info.flags |= VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_COMPACTION_BIT_KHR;
  info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  info.geometryCount = static_cast<std::uint32_t>(geometries.size());
  info.pGeometries = geometries.data();
  std::vector<std::uint32_t> counts;
  counts.reserve(ranges.size());
  for (const auto& range : ranges) counts.push_back(range.primitiveCount);
  VkAccelerationStructureBuildSizesInfoKHR sizes{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
  device.functions().getAccelerationStructureBuildSizes(device.get(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR,
                                                        &info, counts.data(), &sizes);

  Level result = makeLevel(device, type, sizes.accelerationStructureSize);
  const VkDeviceSize alignment = device.capabilities().minAccelerationStructureScratchOffsetAlignment;
  const Buffer scratch(device, fmt::format("scratch of the {}", levelName(type)), sizes.buildScratchSize + alignment,
                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, kDeviceMemory);
  info.dstAccelerationStructure = result.structure.get();
  info.scratchData.deviceAddress = (scratch.address() + alignment - 1) / alignment * alignment;
  const VkAccelerationStructureBuildRangeInfoKHR* const first = ranges.data();
  device.submit(fmt::format("build of the {}", levelName(type)), [&](VkCommandBuffer commands) {
    device.functions().cmdBuildAccelerationStructures(commands, 1, &info, &first);
  });
  return result;
}

}  // namespace malus::vulkan
