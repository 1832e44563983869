#include "render/vulkan/renderer.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/scene/methods.h"
#include "render/scene/render_scene.h"
#include "render/vulkan/acceleration.h"
#include "render/vulkan/host_buffers.h"
#include "render/vulkan/launches.h"
#include "render/vulkan/pixel_buffer.h"
#include "render/vulkan/programs.h"
#include "render/vulkan/scene_buffers.h"
#include "render/vulkan/shared_targets.h"
#include "render/vulkan/timestamps.h"
#include "render/vulkan/tracing_choice.h"

namespace malus::vulkan {
using Clock = std::chrono::steady_clock;

namespace {

double durationMs(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}
// Most bytes of the pixels of a launch: a copy of the whole image would exceed the memory of some devices.
constexpr std::uint64_t kMaxPixelBytes = std::uint64_t{1} << 27;

double elapsedMs(Clock::time_point start) { return durationMs(start, Clock::now()); }

}  // namespace

// Destination of the pixels of an image.
struct Renderer::Target {
  const render::SharedPixels* shared = nullptr;  // null: the host
  std::size_t first = 0;                         // value of the first pixel in shared memory
};

// Members are destroyed in reverse order: each may refer to those before it.
struct Renderer::Impl {
  Impl(const pack::Scene& packScene, const Options& options)
      : instance(options.threads),
        device(instance, options.device, {.importsMemory = options.sharesPixels}),
        scene(packScene),
        needs(render::findGeometryNeeds(packScene)),
        renderScene(render::makeRenderScene(packScene)),
        uploading(Clock::now()),
        buffers(device, renderScene),
        building(Clock::now()),
        acceleration(device, renderScene, buffers.positions, buffers.triangles),
        built(Clock::now()),
        bindings(device),
        host(device, bindings),
        pixels(device),
        targets(device),
        timestamps(device),
        programs(device, renderScene, bindings.layout()) {
    buffers.bind(bindings);
    bindings.bind(Binding::tlas, acceleration.top());
  }

  double dispatch(const Program& program, const gpu::CameraParameters& camera, std::size_t channels,
                  const Target& target);
  std::uint64_t maxLaunchPixels(std::size_t channels) const;
  void launchAll(const Program& program, const Variant& variant, const render::RenderParameters& parameters,
                 render::RenderResult& image, const Target& target);
  render::RenderResult trace(const Variant& variant, const render::RenderParameters& parameters,
                             const Target& target = {});
  gpu::Faults findFaults(const Variant& variant, const render::RenderParameters& parameters);
  render::Faults checkNumerics(Variant variant, const render::RenderParameters& parameters);

  Instance instance;
  Device device;
  const pack::Scene& scene;
  render::GeometryNeeds needs;
  render::RenderScene renderScene;
  Clock::time_point uploading;
  SceneBuffers buffers;
  Clock::time_point building;
  Acceleration acceleration;
  Clock::time_point built;
  Bindings bindings;
  HostBuffers host;
  PixelBuffer pixels;
  SharedTargets targets;
  Timestamps timestamps;
  Programs programs;
  std::map<std::pair<Variant, std::uint32_t>, LaunchSize> launchSizes;  // by variant and depth
  std::function<void(double)> progress;
};

Renderer::Renderer(const pack::Scene& scene, const Options& options) : impl_(std::make_unique<Impl>(scene, options)) {}

Renderer::~Renderer() = default;

std::string Renderer::device() const {
  return fmt::format("{}, {}", impl_->device.physical().name, impl_->device.physical().driver);
}

std::vector<std::string> Renderer::methods() const { return render::methodNames(); }

std::vector<render::VulkanPath> Renderer::vulkanPaths() const { return availablePaths(impl_->device); }

namespace {
// The shader of each mesh's hits is chosen by the kind of its surface.
std::vector<gpu::uint> surfaceKinds(const render::RenderScene& scene) {
  std::vector<gpu::uint> kinds;
  for (const gpu::Material& m : scene.materials) kinds.push_back(m.kind);
  return kinds;
}
}  // namespace

bool Renderer::updateScene() {
  const std::vector<gpu::uint> kinds = surfaceKinds(impl_->renderScene);
  if (render::findGeometryNeeds(impl_->scene) != impl_->needs) return false;
  render::updateSurfaces(impl_->scene, impl_->renderScene);
  if (surfaceKinds(impl_->renderScene) != kinds) return false;
  impl_->buffers.updateSurfaces(impl_->device, impl_->renderScene);
  impl_->buffers.bind(impl_->bindings);
  return true;
}

// Traces the camera's region, copies it to the target or, without one, to the host, and waits. Returns the time of the
// submission in milliseconds.
double Renderer::Impl::dispatch(const Program& program, const gpu::CameraParameters& camera, std::size_t channels,
                                const Target& target) {
  host.camera.write(camera);
  const auto start = Clock::now();
  device.submit("trace", [&](VkCommandBuffer commands) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, program.pipeline->get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, program.pipeline->layout(), 0, 1,
                            &bindings.set(), 0, nullptr);
    timestamps.begin(commands);
    program.table.trace(commands, camera.regionWidth, camera.regionHeight);
    timestamps.end(commands);
    const std::size_t count = std::size_t{camera.regionWidth} * camera.regionHeight * channels;
    pixels.recordBarrier(commands);
    if (target.shared)
      targets.recordCopy(commands, pixels.get(), *target.shared, target.first * sizeof(float), count * sizeof(float));
    else
      pixels.recordCopy(commands, count);
  });
  return elapsedMs(start);
}

// Most pixels of a launch by the device's limits, at least 1.
std::uint64_t Renderer::Impl::maxLaunchPixels(std::size_t channels) const {
  const Capabilities& limits = device.capabilities();
  const std::uint64_t bytes = std::min({limits.maxStorageBufferRange, limits.maxMemoryAllocationSize, kMaxPixelBytes});
  return std::max<std::uint64_t>(1, std::min(bytes / (channels * sizeof(float)), limits.maxRayDispatchInvocationCount));
}

// Renders the image launch by launch. Adds to its cost.
void Renderer::Impl::launchAll(const Program& program, const Variant& variant,
                               const render::RenderParameters& parameters, render::RenderResult& image,
                               const Target& target) {
  const std::uint64_t perPixel = std::uint64_t{parameters.samples} * parameters.samples,
                      most = maxLaunchPixels(image.channels);
  gpu::CameraParameters camera = render::makeCameraParameters(scene, parameters);
  LaunchSize& size = launchSizes[{variant, parameters.depth}];
  size.beginImage();
  auto reported = Clock::now();
  for (LaunchRegions regions(parameters.region); !regions.isDone(); ++image.cost.launches) {
    const std::size_t first = regions.nextPixel() * image.channels;
    const render::Region part = regions.next(std::min(size.pixels(perPixel), most));
    const std::uint64_t count = std::uint64_t{part.width} * part.height;
    camera.regionX = part.x;
    camera.regionY = part.y;
    camera.regionWidth = part.width;
    camera.regionHeight = part.height;
    host.rayCount.write(0);
    const double ms = dispatch(program, camera, image.channels, {target.shared, target.first + first});
    size.add(count, perPixel, ms);
    image.cost.traceMs += timestamps.readMs().value_or(ms);
    image.cost.rays += host.rayCount.read();
    if (!target.shared) {
      const auto reading = Clock::now();
      pixels.read(std::span(image.pixels).subspan(first, count * image.channels));
      image.cost.readBackMs += elapsedMs(reading);
    }
    if (interrupted()) throw Interrupted();
    if (progress && elapsedMs(reported) > 1000) {
      progress(static_cast<double>(regions.nextPixel()) /
               (static_cast<double>(parameters.region.width) * parameters.region.height));
      reported = Clock::now();
    }
  }
}

render::RenderResult Renderer::Impl::trace(const Variant& variant, const render::RenderParameters& parameters,
                                           const Target& target) {
  Program& program = programs.get({variant, requiredRecursion(variant.tracing, parameters.depth)});
  render::RenderResult image;
  image.width = parameters.region.width;
  image.height = parameters.region.height;
  image.channels = render::hasStokes(render::methodNamed(variant.method), parameters) ? render::kStokesChannels
                                                                                      : render::kColourChannels;
  const std::size_t count = std::size_t{image.width} * image.height;
  pixels.reserve(image.channels * std::min<std::uint64_t>(count, maxLaunchPixels(image.channels)), bindings);
  if (!target.shared) {
    image.pixels.resize(image.channels * count);
    pixels.reserveCopy();
  }

  image.cost.uploadMs = durationMs(uploading, building);
  image.cost.buildMs = durationMs(building, built);
  // Drivers finish compiling at the first trace: trace one pixel before the timed trace.
  if (!program.isTraced && !variant.countRays && !variant.checkNumerics) {
    gpu::CameraParameters onePixel = render::makeCameraParameters(scene, parameters);
    onePixel.regionWidth = onePixel.regionHeight = 1;
    image.cost.compileMs = program.compileMs + dispatch(program, onePixel, image.channels, target);
    program.isTraced = true;
  }

  const auto tracing = Clock::now();
  launchAll(program, variant, parameters, image, target);
  image.cost.wallMs = elapsedMs(tracing);
  instance.requireNoMessages();
  return image;
}

// Renders by a variant that checks values, for its faults only.
gpu::Faults Renderer::Impl::findFaults(const Variant& variant, const render::RenderParameters& parameters) {
  gpu::Faults none{};
  none.firstPixel = ~0u;
  host.faults.write(none);
  trace(variant, parameters);
  return host.faults.read();
}

render::Faults Renderer::Impl::checkNumerics(Variant variant, const render::RenderParameters& parameters) {
  variant.checkNumerics = true;
  const gpu::Faults found = findFaults(variant, parameters);
  render::Faults result;
  result.count = found.count;
  if (found.count == 0) return result;
  // Render the first pixel alone: its values then occur in order.
  render::RenderParameters onePixel = parameters;
  onePixel.region = {found.firstPixel % parameters.width, found.firstPixel / parameters.width, 1, 1};
  result.first = findFaults(variant, onePixel).fault;
  return result;
}

render::RenderResult Renderer::render(std::string_view method, const render::RenderParameters& parameters) {
  return render(method, parameters, Target{});
}

bool Renderer::acceptTarget(const std::shared_ptr<const render::SharedPixels>& target) {
  return impl_->targets.accept(target);
}

render::RenderResult Renderer::renderTo(std::string_view method, const render::RenderParameters& parameters,
                                        const render::SharedPixels& target, std::size_t first) {
  return render(method, parameters, Target{&target, first});
}

void Renderer::releaseTargets() { impl_->targets.release(); }

render::RenderResult Renderer::render(std::string_view method, const render::RenderParameters& parameters,
                                      const Target& target) {
  impl_->progress = progress();
  const TracingChoice choice = chooseTracing(impl_->device, render::methodNamed(method), impl_->scene, parameters);
  const Variant variant = variantFor(impl_->scene, method, parameters, choice.tracing);
  render::RenderResult image = impl_->trace(variant, parameters, target);
  image.device = device();
  image.vulkanPath = vulkanPath(choice.tracing);
  image.withoutRecursion = choice.withoutRecursion;
  if (parameters.checkNumerics) image.faults = impl_->checkNumerics(variant, parameters);
  return image;
}

void Renderer::prepare(const std::vector<render::Preparation>& images) {
  std::vector<Programs::Key> keys;
  for (const render::Preparation& image : images) try {
      const TracingChoice choice =
          chooseTracing(impl_->device, render::methodNamed(image.method), impl_->scene, image.parameters);
      Variant variant = variantFor(impl_->scene, image.method, image.parameters, choice.tracing);
      keys.push_back({variant, requiredRecursion(choice.tracing, image.parameters.depth)});
      variant.countRays = true;
      if (image.countRays) keys.push_back({variant, keys.back().recursion});
    } catch (const Error&) {  // reported by render()
    }
  impl_->programs.compile(keys);
}

std::uint64_t Renderer::countRays(std::string_view method, const render::RenderParameters& parameters) {
  const TracingChoice choice = chooseTracing(impl_->device, render::methodNamed(method), impl_->scene, parameters);
  Variant variant = variantFor(impl_->scene, method, parameters, choice.tracing);
  variant.countRays = true;
  return impl_->trace(variant, parameters).cost.rays;
}

}  // namespace malus::vulkan
