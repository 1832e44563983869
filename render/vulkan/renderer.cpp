#include "render/vulkan/renderer.h"

#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bake/pack/format.h"
#include "meshprep/base/error.h"
#include "render/scene/methods.h"
#include "render/scene/render_scene.h"
#include "render/vulkan/acceleration.h"
#include "render/vulkan/bindings.h"
#include "render/vulkan/check.h"
#include "render/vulkan/pipeline.h"

namespace malus::vulkan {
using Clock = std::chrono::steady_clock;

namespace {

double betweenMs(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}
double sinceMs(Clock::time_point start) { return betweenMs(start, Clock::now()); }

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
constexpr VkBufferUsageFlags kBuildInput = kStorage | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                                           VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

// Descriptor set with one entry a binding, and its layout and pool.
class Bindings {
 public:
  explicit Bindings(const Device& device) : device_(device) {
    layout_ = createBindingsLayout(device);
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 1},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kBindings - 1}};
    VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool.maxSets = 1;
    pool.poolSizeCount = 2;
    pool.pPoolSizes = sizes;
    check(vkCreateDescriptorPool(device.get(), &pool, nullptr, &pool_), "vkCreateDescriptorPool");
    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = pool_;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout_;
    check(vkAllocateDescriptorSets(device.get(), &allocate, &set_), "vkAllocateDescriptorSets");
  }
  ~Bindings() {
    if (pool_) vkDestroyDescriptorPool(device_.get(), pool_, nullptr);
    if (layout_) vkDestroyDescriptorSetLayout(device_.get(), layout_, nullptr);
  }
  Bindings(const Bindings&) = delete;
  Bindings& operator=(const Bindings&) = delete;

  VkDescriptorSetLayout layout() const { return layout_; }
  const VkDescriptorSet& set() const { return set_; }

  // Throws Error where the device cannot bind all textures at once.
  void bind(Binding binding, const Buffer& buffer) {
    if (binding == kTextureTexels && buffer.sizeBytes() > device_.maxStorageBufferBytes())
      throw Error(fmt::format("device '{}'", device_.physical().name), "cannot hold the scene's textures in one buffer",
                  fmt::format("at most {} bytes", device_.maxStorageBufferBytes()),
                  fmt::format("{}", buffer.sizeBytes()));
    const VkDescriptorBufferInfo info{buffer.get(), 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write = writeOf(binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    write.pBufferInfo = &info;
    vkUpdateDescriptorSets(device_.get(), 1, &write, 0, nullptr);
  }
  void bind(VkAccelerationStructureKHR top) {
    VkWriteDescriptorSetAccelerationStructureKHR info{
        VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR};
    info.accelerationStructureCount = 1;
    info.pAccelerationStructures = &top;
    VkWriteDescriptorSet write = writeOf(kTlas, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR);
    write.pNext = &info;
    vkUpdateDescriptorSets(device_.get(), 1, &write, 0, nullptr);
  }

 private:
  VkWriteDescriptorSet writeOf(Binding binding, VkDescriptorType type) const {
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set_;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = type;
    return write;
  }
  const Device& device_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

// Two timestamps around the trace.
class Timestamps {
 public:
  explicit Timestamps(const Device& device) : device_(device) {
    if (device.timestampPeriodNs() == 0) return;
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = 2;
    check(vkCreateQueryPool(device.get(), &info, nullptr, &pool_), "vkCreateQueryPool");
  }
  ~Timestamps() {
    if (pool_) vkDestroyQueryPool(device_.get(), pool_, nullptr);
  }
  Timestamps(const Timestamps&) = delete;
  Timestamps& operator=(const Timestamps&) = delete;

  void begin(VkCommandBuffer commands) const {
    if (!pool_) return;
    vkCmdResetQueryPool(commands, pool_, 0, 2);
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, pool_, 0);
  }
  void end(VkCommandBuffer commands) const {
    if (pool_) vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_RAY_TRACING_SHADER_BIT_KHR, pool_, 1);
  }
  std::optional<double> elapsedMs() const {
    if (!pool_) return std::nullopt;
    std::uint64_t ticks[2] = {};
    check(vkGetQueryPoolResults(device_.get(), pool_, 0, 2, sizeof ticks, ticks, sizeof ticks[0],
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
    return static_cast<double>(ticks[1] - ticks[0]) * device_.timestampPeriodNs() * 1e-6;
  }

 private:
  const Device& device_;
  VkQueryPool pool_ = VK_NULL_HANDLE;
};

}  // namespace

struct Renderer::Impl {
  Impl(const pack::Scene& source, const Options& options)
      : instance(options.threads),
        device(instance, options.device),
        scene(source),
        floats(render::makeRenderScene(source)),
        uploading(Clock::now()),
        materials(uploaded(device, bytesOf(floats.materials), kStorage)),
        lights(uploaded(device, bytesOf(floats.lights), kStorage)),
        meshes(uploaded(device, bytesOf(floats.meshes), kStorage)),
        triangles(uploaded(device, bytesOf(floats.triangles), kBuildInput)),
        positions(uploaded(device, bytesOf(floats.positions), kBuildInput)),
        normals(uploaded(device, bytesOf(floats.normals), kStorage)),
        texels(uploaded(device, bytesOf(floats.environmentTexels), kStorage)),
        extras(uploaded(device, bytesOf(floats.extras), kStorage)),
        textures(uploaded(device, bytesOf(floats.textures), kStorage)),
        textureTexels(uploaded(device, bytesOf(floats.textureTexels), kStorage)),
        frame(device, sizeof(gpu::CameraParameters), kStorage, kHost),
        counter(device, sizeof(std::uint32_t), kStorage, kHost),
        faults(device, sizeof(gpu::Faults), kStorage, kHost),
        building(Clock::now()),
        acceleration(device, floats, positions, triangles),
        built(Clock::now()),
        bindings(device),
        timestamps(device) {
    bindings.bind(acceleration.top());
    bindings.bind(kFrame, frame);
    bindings.bind(kMaterials, materials);
    bindings.bind(kLights, lights);
    bindings.bind(kMeshes, meshes);
    bindings.bind(kTriangles, triangles);
    bindings.bind(kPositions, positions);
    bindings.bind(kNormals, normals);
    bindings.bind(kTexels, texels);
    bindings.bind(kCounter, counter);
    bindings.bind(kFaults, faults);
    bindings.bind(kExtras, extras);
    bindings.bind(kTextures, textures);
    bindings.bind(kTextureTexels, textureTexels);
  }

  const Pipeline& pipelineFor(const Variant& variant, std::uint32_t recursion);
  render::RenderResult trace(const Variant& variant, const render::RenderParameters& parameters);
  gpu::Faults faultsOf(const Variant& variant, const render::RenderParameters& parameters);

  Instance instance;
  Device device;
  const pack::Scene& scene;
  render::RenderScene floats;
  Clock::time_point uploading;
  Buffer materials, lights, meshes, triangles, positions, normals, texels, extras, textures, textureTexels, frame,
      counter, faults, pixels, readBack;
  Clock::time_point building;
  Acceleration acceleration;
  Clock::time_point built;
  Bindings bindings;
  Timestamps timestamps;
  std::map<std::pair<Variant, std::uint32_t>, std::unique_ptr<Pipeline>> pipelines;
};

Renderer::Renderer(const pack::Scene& scene, const Options& options) { impl_ = std::make_unique<Impl>(scene, options); }

Renderer::~Renderer() = default;

std::string Renderer::device() const {
  return fmt::format("{}, {}", impl_->device.physical().name, impl_->device.physical().driver);
}

std::vector<std::string> Renderer::methods() const {
  std::vector<std::string> names;
  for (const render::MethodInfo& m : render::methods())
    if (!m.isIterative || impl_->device.hasRayQueries()) names.push_back(m.name);
  return names;
}

std::uint32_t Renderer::maxDepth(std::string_view method) const {
  if (render::methodNamed(method).isIterative) return pack::kMaxDepth;
  const std::uint32_t limit = impl_->device.rayTracing().maxRayRecursionDepth;
  return limit < 2 ? 0 : limit - 2;  // the camera ray, and a shadow ray from the last hit
}

const Pipeline& Renderer::Impl::pipelineFor(const Variant& variant, std::uint32_t recursion) {
  std::unique_ptr<Pipeline>& pipeline = pipelines[{variant, recursion}];
  if (!pipeline) pipeline = std::make_unique<Pipeline>(device, variant, floats, bindings.layout(), recursion);
  return *pipeline;
}

render::RenderResult Renderer::Impl::trace(const Variant& variant, const render::RenderParameters& parameters) {
  const auto preparing = Clock::now();
  // Beside the interactions: the camera ray, and a shadow ray from the last hit. A loop does not recurse.
  const std::uint32_t recursion = variant.stackSize > 0 ? 1 : parameters.depth + 2;
  const bool fresh = !pipelines.contains({variant, recursion});
  const Pipeline& pipeline = pipelineFor(variant, recursion);
  render::RenderResult picture;
  picture.width = parameters.region.width;
  picture.height = parameters.region.height;
  picture.channels = render::hasStokes(render::methodNamed(variant.method), parameters) ? render::kStokesChannels
                                                                                        : render::kColourChannels;
  picture.pixels.resize(picture.channels * picture.width * picture.height);
  const VkDeviceSize bytes = picture.pixels.size() * sizeof(float);
  if (pixels.sizeBytes() < bytes) {
    pixels = Buffer(device, bytes, kStorage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    readBack = Buffer(device, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, kHost);
    bindings.bind(kPixels, pixels);
  }
  gpu::CameraParameters constants = render::makeCameraParameters(scene, parameters);
  const std::uint32_t zero = 0;
  counter.write(std::as_bytes(std::span(&zero, 1)));

  const auto dispatch = [&](const gpu::CameraParameters& f) {
    frame.write(std::as_bytes(std::span(&f, 1)));
    device.submit([&](VkCommandBuffer commands) {
      vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, pipeline.get());
      vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, pipeline.layout(), 0, 1,
                              &bindings.set(), 0, nullptr);
      timestamps.begin(commands);
      pipeline.trace(commands, f.regionWidth, f.regionHeight);
      timestamps.end(commands);
      const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_SHADER_WRITE_BIT,
                                    VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_HOST_READ_BIT};
      vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_RAY_TRACING_SHADER_BIT_KHR,
                           VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0,
                           nullptr);
      const VkBufferCopy copy{0, 0, std::size_t{f.regionWidth} * f.regionHeight * picture.channels * sizeof(float)};
      vkCmdCopyBuffer(commands, pixels.get(), readBack.get(), 1, &copy);
    });
  };

  // Drivers finish compiling at the first trace: one pixel warms them up, outside of the time.
  if (fresh && !variant.countRays && !variant.checkNumerics) {
    gpu::CameraParameters one = constants;
    one.regionWidth = one.regionHeight = 1;
    dispatch(one);
  }
  picture.cost.uploadMs = betweenMs(uploading, building);
  picture.cost.buildMs = betweenMs(building, built);
  picture.cost.compileMs = fresh ? sinceMs(preparing) : 0;

  const auto start = Clock::now();
  dispatch(constants);
  const double wallMs = sinceMs(start);
  const auto reading = Clock::now();
  readBack.read(std::as_writable_bytes(std::span(picture.pixels)));
  picture.cost.readBackMs = sinceMs(reading);
  picture.cost.wallMs = sinceMs(start);
  picture.cost.traceMs = timestamps.elapsedMs().value_or(wallMs);
  std::uint32_t rays = 0;
  counter.read(std::as_writable_bytes(std::span(&rays, 1)));
  picture.cost.rays = rays;
  instance.requireNoMessages();
  return picture;
}

// A picture by a variant that checks, for what it finds alone.
gpu::Faults Renderer::Impl::faultsOf(const Variant& variant, const render::RenderParameters& parameters) {
  gpu::Faults found{};
  found.firstPixel = ~0u;
  faults.write(std::as_bytes(std::span(&found, 1)));
  trace(variant, parameters);
  faults.read(std::as_writable_bytes(std::span(&found, 1)));
  return found;
}

render::RenderResult Renderer::render(std::string_view method, const render::RenderParameters& parameters) {
  const bool isIterative = render::methodNamed(method).isIterative;
  if (isIterative && !impl_->device.hasRayQueries())
    throw Error("--method", fmt::format("device '{}' has no ray queries", impl_->device.physical().name),
                "a method that recurses", method);
  if (parameters.depth > maxDepth(method))
    throw Error("--depth", fmt::format("device '{}' cannot recurse that deep", impl_->device.physical().name),
                fmt::format("at most {}", maxDepth(method)), fmt::format("{}", parameters.depth));
  Variant variant = variantFor(impl_->scene, method, parameters);
  render::RenderResult picture = impl_->trace(variant, parameters);
  picture.device = device();
  if (parameters.checkNumerics) {
    variant.checkNumerics = true;
    const gpu::Faults found = impl_->faultsOf(variant, parameters);
    picture.faults.count = found.count;
    if (found.count > 0) {
      // The first pixel once more, alone.
      render::RenderParameters one = parameters;
      one.region = {found.firstPixel % parameters.width, found.firstPixel / parameters.width, 1, 1};
      picture.faults.first = impl_->faultsOf(variant, one).fault;
    }
  }
  return picture;
}

std::uint64_t Renderer::countRays(std::string_view method, const render::RenderParameters& parameters) {
  Variant variant = variantFor(impl_->scene, method, parameters);
  variant.countRays = true;
  return impl_->trace(variant, parameters).cost.rays;
}

std::vector<DeviceDescription> devices() {
  const Instance instance(0);
  std::vector<DeviceDescription> result;
  for (const PhysicalDevice& d : describeDevices(instance)) result.push_back({d.name, d.driver, d.problem});
  return result;
}

}  // namespace malus::vulkan
