#include "render/vulkan/ray_replay.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <utility>

#include "render/scene/render_scene.h"
#include "render/vulkan/acceleration.h"
#include "render/vulkan/pipeline.h"
#include "render/vulkan/scene_buffers.h"
#include "render/vulkan/shader_table.h"
#include "render/vulkan/timestamps.h"
#include "render/vulkan/tracing_choice.h"
#include "render/vulkan/uploads.h"

namespace malus::vulkan {

namespace {

constexpr std::uint32_t kLaunchWidth = 1024;  // of the launch; its height follows from the rays
constexpr std::uint32_t kMissed = 0xffffffff;
constexpr std::size_t kHeaderBytes = sizeof(std::uint32_t);  // rayCount

// The descriptors of shaders/stages/replay.rgen.
constexpr std::array kDescriptorTypes = {VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR,
                                         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

Owned<VkDescriptorSetLayout> createLayout(const Device& device) {
  std::array<VkDescriptorSetLayoutBinding, kDescriptorTypes.size()> list{};
  for (std::uint32_t i = 0; i < list.size(); ++i)
    list[i] = {i, kDescriptorTypes[i], 1, VK_SHADER_STAGE_RAYGEN_BIT_KHR, nullptr};
  VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  info.bindingCount = static_cast<std::uint32_t>(list.size());
  info.pBindings = list.data();
  return create(device.get(), vkCreateDescriptorSetLayout, info, vkDestroyDescriptorSetLayout,
                "vkCreateDescriptorSetLayout (recorded rays)");
}

Owned<VkDescriptorPool> createPool(const Device& device) {
  const std::array<VkDescriptorPoolSize, 2> sizes{{{VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 1},  //
                                                   {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2}}};
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.maxSets = 1;
  info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  return create(device.get(), vkCreateDescriptorPool, info, vkDestroyDescriptorPool,
                "vkCreateDescriptorPool (recorded rays)");
}

VkDescriptorSet allocateSet(const Device& device, VkDescriptorPool pool, VkDescriptorSetLayout layout) {
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorPool = pool;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  check(vkAllocateDescriptorSets(device.get(), &info, &set), "vkAllocateDescriptorSets (recorded rays)");
  return set;
}

void writeSet(const Device& device, VkDescriptorSet set, VkAccelerationStructureKHR top,
              const std::array<VkBuffer, 2>& buffers) {
  VkWriteDescriptorSetAccelerationStructureKHR structure{
      VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR};
  structure.accelerationStructureCount = 1;
  structure.pAccelerationStructures = &top;
  const std::array<VkDescriptorBufferInfo, 2> infos{{{buffers[0], 0, VK_WHOLE_SIZE}, {buffers[1], 0, VK_WHOLE_SIZE}}};
  std::array<VkWriteDescriptorSet, kDescriptorTypes.size()> writes{};
  for (std::uint32_t i = 0; i < writes.size(); ++i) {
    writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    writes[i].dstSet = set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = kDescriptorTypes[i];
    if (i == 0)
      writes[i].pNext = &structure;
    else
      writes[i].pBufferInfo = &infos[i - 1];
  }
  vkUpdateDescriptorSets(device.get(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

struct ReplayProgram {
  Pipeline pipeline;
  ShaderTable table;
};

}  // namespace

// Members are destroyed in reverse order: each may refer to those before it.
struct RayReplay::Impl {
  Impl(const pack::Scene& scene, const Options& options)
      : instance(options.threads),
        device(instance, options.device),
        renderScene(render::makeRenderScene(scene)),
        buffers(device, renderScene),
        acceleration(device, renderScene, buffers.positions, buffers.triangles),
        layout(createLayout(device)),
        pool(createPool(device)),
        set(allocateSet(device, pool.get(), layout.get())),
        timestamps(device),
        input(device, "recorded rays", kHeaderBytes + kReplayRays * sizeof(RecordedRay),
              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, kDeviceMemory),
        output(device, "hits of recorded rays", kReplayRays * sizeof(std::uint32_t),
               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, kDeviceMemory),
        copy(device, "copy of the hits", kReplayRays * sizeof(std::uint32_t), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
             kReadBackMemory) {
    writeSet(device, set, acceleration.top(), {input.get(), output.get()});
  }

  ReplayProgram& program(render::VulkanPath path, bool shadow);
  double launch(const ReplayProgram& program, std::span<const RecordedRay> rays);
  std::uint64_t countHits(std::size_t rays) const;

  Instance instance;
  Device device;
  render::RenderScene renderScene;
  SceneBuffers buffers;
  Acceleration acceleration;
  Owned<VkDescriptorSetLayout> layout;
  Owned<VkDescriptorPool> pool;
  VkDescriptorSet set;  // freed with its pool
  Timestamps timestamps;
  Buffer input, output, copy;
  std::map<std::pair<render::VulkanPath, bool>, ReplayProgram> programs;
};

// Compiles at the first use, and traces one ray, because drivers finish compiling at the first trace.
ReplayProgram& RayReplay::Impl::program(render::VulkanPath path, bool shadow) {
  const std::pair key{path, shadow};
  if (const auto found = programs.find(key); found != programs.end()) return found->second;
  Variant variant;
  variant.replay = shadow ? Replay::shadow : Replay::nearest;
  variant.tracing = path == render::VulkanPath::query ? Tracing::rayQueries : Tracing::hitRecords;
  variant.stackSize = 1;
  Pipeline pipeline(device, variant, layout.get(), requiredRecursion(variant.tracing, 0));
  ShaderTable table(device, pipeline.get(), stageSources(variant), renderScene);
  ReplayProgram& made = programs.emplace(key, ReplayProgram{std::move(pipeline), std::move(table)}).first->second;
  const RecordedRay ray{{0, 0, 0}, {0, 0, 1}};
  launch(made, {&ray, 1});
  return made;
}

// Returns the time of the trace in milliseconds.
double RayReplay::Impl::launch(const ReplayProgram& program, std::span<const RecordedRay> rays) {
  const auto count = static_cast<std::uint32_t>(rays.size());
  std::vector<std::byte> bytes(kHeaderBytes + rays.size_bytes());
  std::ranges::copy(std::as_bytes(std::span(&count, 1)), bytes.begin());
  std::ranges::copy(std::as_bytes(rays), bytes.begin() + kHeaderBytes);
  copyToBuffer(device, "recorded rays", bytes, input);
  const std::uint32_t width = std::min(count, kLaunchWidth), height = (count + width - 1) / width;
  const auto start = std::chrono::steady_clock::now();
  device.submit("recorded rays", [&](VkCommandBuffer commands) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, program.pipeline.get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, program.pipeline.layout(), 0, 1, &set, 0,
                            nullptr);
    timestamps.begin(commands);
    program.table.trace(commands, width, height);
    timestamps.end(commands);
  });
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  device.submit("copy of the hits", [&](VkCommandBuffer commands) {
    const VkBufferCopy region{0, 0, count * sizeof(std::uint32_t)};
    vkCmdCopyBuffer(commands, output.get(), copy.get(), 1, &region);
  });
  return timestamps.readMs().value_or(ms);
}

std::uint64_t RayReplay::Impl::countHits(std::size_t rays) const {
  std::vector<std::uint32_t> hits(rays);
  copy.read(std::as_writable_bytes(std::span(hits)));
  return rays - static_cast<std::uint64_t>(std::ranges::count(hits, kMissed));
}

RayReplay::RayReplay(const pack::Scene& scene, const Options& options)
    : impl_(std::make_unique<Impl>(scene, options)) {}

RayReplay::~RayReplay() = default;

std::vector<render::VulkanPath> RayReplay::paths() const { return availablePaths(impl_->device); }

ReplayTime RayReplay::replay(render::VulkanPath path, bool shadow, std::span<const RecordedRay> rays) {
  const ReplayProgram& program = impl_->program(path, shadow);
  ReplayTime result;
  for (std::size_t at = 0; at < rays.size(); at += kReplayRays) {
    const std::size_t count = std::min(kReplayRays, rays.size() - at);
    result.ms += impl_->launch(program, rays.subspan(at, count));
    result.hits += impl_->countHits(count);
  }
  impl_->instance.requireNoMessages();
  return result;
}

}  // namespace malus::vulkan
