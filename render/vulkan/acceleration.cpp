#include "render/vulkan/acceleration.h"

#include <algorithm>
#include <span>
#include <utility>

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
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const bool isShared = i > 0 && scene.meshTransforms[i].kind != gpu::kUnplaced &&
                          scene.meshes[i].firstTriangle == scene.meshes[i - 1].firstTriangle;
    if (!isShared) triangles += scene.meshTriangles[i];
  }
  require("triangles", triangles, limits.maxPrimitiveCount, "maxPrimitiveCount");
}

const char* levelName(VkAccelerationStructureTypeKHR type) {
  return type == VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR ? "top-level structure" : "bottom-level structure";
}

// Bytes of bottom-level structures that are built before they are compacted. Bounds the memory for those that are not
// compacted yet.
constexpr VkDeviceSize kBatchBytes = VkDeviceSize{1} << 28;

// One geometry per mesh, opaque without cut-outs, in the order of the meshes: gl_InstanceCustomIndexEXT +
// gl_GeometryIndexEXT is the index of the mesh and of its hit record. Both sides of a triangle are hit: rays leave
// glass through the back.
void addGeometries(const render::RenderScene& scene, const render::MeshRun& run, const Buffer& positions,
                   const Buffer& triangles, std::vector<VkAccelerationStructureGeometryKHR>& geometries,
                   std::vector<VkAccelerationStructureBuildRangeInfoKHR>& ranges) {
  for (std::size_t i = run.first; i < run.first + run.count; ++i) {
    VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    geometry.flags = render::hasCutOuts(scene, i) ? 0 : VK_GEOMETRY_OPAQUE_BIT_KHR;
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
}

VkTransformMatrixKHR makeTransform(const render::RenderScene& scene, const render::MeshRun& run) {
  const gpu::MeshTransform& t = scene.meshTransforms[run.first];
  const glm::vec3& origin = scene.meshes[run.first].origin;
  const glm::vec3 &x = t.linearX, &y = t.linearY, &z = t.linearZ;
  return {{{x.x, y.x, z.x, origin.x}, {x.y, y.y, z.y, origin.y}, {x.z, y.z, z.z, origin.z}}};
}

// Orders two builds or copies of structures: they share scratch memory, or one reads what the other writes.
void recordBarrier(VkCommandBuffer commands) {
  constexpr VkAccessFlags kAccess =
      VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR | VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
  const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, kAccess, kAccess};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
                       VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace

// A structure that is about to be built. Info refers to the geometries.
struct Acceleration::Build {
  Build(const Device& device, VkAccelerationStructureTypeKHR type,
        std::vector<VkAccelerationStructureGeometryKHR> itsGeometries,
        std::vector<VkAccelerationStructureBuildRangeInfoKHR> itsRanges);

  std::vector<VkAccelerationStructureGeometryKHR> geometries;
  std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;  // of the primitives of each geometry
  VkAccelerationStructureBuildGeometryInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
  VkDeviceSize scratchBytes = 0;
  Level level;
};

Acceleration::Build::Build(const Device& device, VkAccelerationStructureTypeKHR type,
                           std::vector<VkAccelerationStructureGeometryKHR> itsGeometries,
                           std::vector<VkAccelerationStructureBuildRangeInfoKHR> itsRanges)
    : geometries(std::move(itsGeometries)), ranges(std::move(itsRanges)) {
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
  scratchBytes = sizes.buildScratchSize;
  level = makeLevel(device, type, sizes.accelerationStructureSize);
  info.dstAccelerationStructure = level.structure.get();
}

Acceleration::Acceleration(const Device& device, const render::RenderScene& scene, const Buffer& positions,
                           const Buffer& triangles)
    : bottoms_(buildBottoms(device, scene, positions, triangles)),
      top_(buildTop(device, scene, bottoms_)),
      instances_(render::findMeshRuns(scene).size()) {}

VkDeviceSize Acceleration::bottomBytes() const {
  VkDeviceSize bytes = 0;
  for (const Level& bottom : bottoms_) bytes += bottom.storage.sizeBytes();
  return bytes;
}

std::vector<Acceleration::Level> Acceleration::buildBottoms(const Device& device, const render::RenderScene& scene,
                                                            const Buffer& positions, const Buffer& triangles) {
  requireCounts(device, scene);
  std::vector<Level> bottoms;
  std::vector<Build> batch;
  VkDeviceSize bytes = 0;
  const auto finishBatch = [&] {
    for (Level& level : compact(device, buildAll(device, batch))) bottoms.push_back(std::move(level));
    batch.clear();
    bytes = 0;
  };
  std::size_t shapes = 0;
  for (const render::MeshRun& run : render::findMeshRuns(scene)) {
    if (run.shape < shapes) continue;  // another place of the last one
    ++shapes;
    std::vector<VkAccelerationStructureGeometryKHR> geometries;
    std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
    addGeometries(scene, run, positions, triangles, geometries, ranges);
    batch.emplace_back(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, std::move(geometries),
                       std::move(ranges));
    bytes += batch.back().level.storage.sizeBytes();
    if (bytes > kBatchBytes) finishBatch();
  }
  if (!batch.empty()) finishBatch();
  return bottoms;
}

// An instance per run of meshes, at their origin, and per place.
Acceleration::Level Acceleration::buildTop(const Device& device, const render::RenderScene& scene,
                                           const std::vector<Level>& bottoms) {
  const std::vector<render::MeshRun> runs = render::findMeshRuns(scene);
  std::vector<VkAccelerationStructureInstanceKHR> list;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    VkAccelerationStructureDeviceAddressInfoKHR addressInfo{
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
    addressInfo.accelerationStructure = bottoms[runs[i].shape].structure.get();
    VkAccelerationStructureInstanceKHR instance{};
    instance.transform = makeTransform(scene, runs[i]);
    instance.mask = 0xff;
    instance.instanceCustomIndex = runs[i].first & 0xffffffu;
    instance.instanceShaderBindingTableRecordOffset = runs[i].first & 0xffffffu;
    instance.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
    instance.accelerationStructureReference =
        device.functions().getAccelerationStructureDeviceAddress(device.get(), &addressInfo);
    list.push_back(instance);
  }
  // Read once, by the build: not worth a copy to device-local memory.
  const std::span bytes = std::as_bytes(std::span(list));
  Buffer instances(
      device, "instances of the scene", bytes.size(),
      VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR,
      kSharedMemory);
  if (!bytes.empty()) instances.write(bytes);
  VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
  geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  geometry.geometry.instances = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
  geometry.geometry.instances.data.deviceAddress = instances.address();
  const VkAccelerationStructureBuildRangeInfoKHR range{static_cast<std::uint32_t>(list.size()), 0, 0, 0};
  std::vector<Build> build;
  build.emplace_back(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, std::vector{geometry}, std::vector{range});
  return std::move(buildAll(device, build).levels.front());
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

Acceleration::Built Acceleration::buildAll(const Device& device, std::vector<Build>& builds) {
  constexpr VkQueryType kQuery = VK_QUERY_TYPE_ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR;
  const VkAccelerationStructureTypeKHR type = builds.front().info.type;
  const bool compacts = type == VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
  const auto count = static_cast<std::uint32_t>(builds.size());
  Built result;
  if (compacts) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = kQuery;
    info.queryCount = count;
    result.sizes =
        create(device.get(), vkCreateQueryPool, info, vkDestroyQueryPool, "vkCreateQueryPool (compacted size)");
  }
  // Structures are built one after another in the same scratch memory.
  const VkDeviceSize alignment = device.capabilities().minAccelerationStructureScratchOffsetAlignment;
  const VkDeviceSize bytes = std::ranges::max_element(builds, {}, &Build::scratchBytes)->scratchBytes;
  const Buffer scratch(device, fmt::format("scratch of the {}", levelName(type)), bytes + alignment,
                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, kDeviceMemory);
  const VkDeviceAddress address = (scratch.address() + alignment - 1) / alignment * alignment;
  std::vector<VkAccelerationStructureKHR> handles;
  handles.reserve(builds.size());
  for (const Build& build : builds) handles.push_back(build.level.structure.get());
  device.submit(fmt::format("build of the {}", levelName(type)), [&](VkCommandBuffer commands) {
    if (compacts) vkCmdResetQueryPool(commands, result.sizes.get(), 0, count);
    for (Build& build : builds) {
      build.info.scratchData.deviceAddress = address;
      const VkAccelerationStructureBuildRangeInfoKHR* const first = build.ranges.data();
      device.functions().cmdBuildAccelerationStructures(commands, 1, &build.info, &first);
      recordBarrier(commands);
    }
    if (compacts)
      device.functions().cmdWriteAccelerationStructuresProperties(commands, count, handles.data(), kQuery,
                                                                  result.sizes.get(), 0);
  });
  for (Build& build : builds) result.levels.push_back(std::move(build.level));
  return result;
}

std::vector<Acceleration::Level> Acceleration::compact(const Device& device, Built built) {
  struct Compaction {
    std::size_t index;
    Level level;
  };
  std::vector<Compaction> compactions;
  for (std::uint32_t i = 0; i < built.levels.size(); ++i) {
    VkDeviceSize bytes = 0;
    check(vkGetQueryPoolResults(device.get(), built.sizes.get(), i, 1, sizeof bytes, &bytes, sizeof bytes,
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults (compacted size)");
    if (bytes > 0 && bytes < built.levels[i].storage.sizeBytes())
      compactions.push_back({i, makeLevel(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, bytes)});
  }
  if (compactions.empty()) return std::move(built.levels);
  device.submit("compaction", [&](VkCommandBuffer commands) {
    for (const Compaction& c : compactions) {
      VkCopyAccelerationStructureInfoKHR copy{VK_STRUCTURE_TYPE_COPY_ACCELERATION_STRUCTURE_INFO_KHR};
      copy.src = built.levels[c.index].structure.get();
      copy.dst = c.level.structure.get();
      copy.mode = VK_COPY_ACCELERATION_STRUCTURE_MODE_COMPACT_KHR;
      device.functions().cmdCopyAccelerationStructure(commands, &copy);
    }
  });
  for (Compaction& c : compactions) built.levels[c.index] = std::move(c.level);
  return std::move(built.levels);
}

}  // namespace malus::vulkan
