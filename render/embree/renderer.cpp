#include "render/embree/renderer.h"

#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/embree/methods.h"
#include "render/embree/packets/packets.h"
#include "render/embree/tile.h"
#include "render/scene/compiled_effects.h"
#include "render/scene/methods.h"
#include "render/scene/render_scene.h"
#include "shaders/effects.h"

namespace malus::embree {
using Clock = std::chrono::steady_clock;

namespace {
constexpr std::uint32_t kTileSide = 16;  // of the scalar path

double sinceMs(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// The first build of a method that contains all effects; the last one contains every effect.
template <class Build>
const Build& findBuild(const std::vector<const Build*>& builds, std::string_view name, std::uint32_t effects) {
  return **std::ranges::find_if(
      builds, [&](const Build* build) { return build->name == name && (effects & ~build->effects) == 0; });
}

// Only the build with every effect checks numerics.
constexpr std::uint32_t kEveryEffect = ~0u >> (32 - shaders::kCompiledEffects.size());

// Throws Error if packets are asked for and the processor cannot run them.
bool tracesSingleRays(const render::RenderParameters& parameters) {
  if (parameters.checkNumerics || parameters.embreePath == render::EmbreePath::scalar) return true;
  if (hasPacketInstructions()) return false;
  if (parameters.embreePath == render::EmbreePath::packet)
    throw Error("--embree-path", "this processor has no instructions for packets", "SSE4.2, AVX2 or AVX-512", "none");
  return true;
}

// Calls renderTile(tile) for the tiles of an image, in parallel, and adds up what it returns.
template <class RenderTile>
void renderTiles(const TileInput& image, tbb::task_arena& arena, std::uint32_t tileWidth, std::uint32_t tileHeight,
                 render::RenderResult& result, RenderTile renderTile) {
  std::atomic<std::uint64_t> tracedRays{0};
  std::mutex merging;
  const gpu::CameraParameters& camera = *image.camera;
  const std::uint32_t columns = (camera.regionWidth + tileWidth - 1) / tileWidth;
  const std::uint32_t rows = (camera.regionHeight + tileHeight - 1) / tileHeight;
  arena.execute([&] {
    tbb::parallel_for(0u, columns * rows, [&](std::uint32_t i) {
      if (interrupted()) return;
      TileInput tile = image;
      tile.beginX = i % columns * tileWidth;
      tile.beginY = i / columns * tileHeight;
      tile.endX = std::min(tile.beginX + tileWidth, camera.regionWidth);
      tile.endY = std::min(tile.beginY + tileHeight, camera.regionHeight);
      const TileOutput output = renderTile(tile);
      tracedRays += output.rays;
      if (output.faults.count == 0) return;
      const std::scoped_lock lock(merging);
      result.faults.add(output.faults, camera.width);
    });
  });
  if (interrupted()) throw Interrupted();
  result.cost.rays = tracedRays;
}
}  // namespace

struct Renderer::Impl {
  Impl(const pack::Scene& packed, unsigned threads)
      : arena(static_cast<int>(threads == 0 ? std::max(1u, std::thread::hardware_concurrency()) : threads)),
        source(&packed),
        needs(render::findGeometryNeeds(packed)),
        scene(render::makeRenderScene(packed)),
        order(scene) {}

  // For every image: TBB frees an arena late, so that memory would grow with the number of small images.
  tbb::task_arena arena;
  pack::Scene const* source;
  render::GeometryNeeds needs;
  render::RenderScene scene;
  ShadingOrder order;
  double buildMs = 0;
  std::unique_ptr<Bvh> bvh;
};

Renderer::Renderer(const pack::Scene& scene, unsigned threads) {
  const auto start = Clock::now();
  impl_ = std::make_unique<Impl>(scene, threads);
  impl_->bvh = std::make_unique<Bvh>(impl_->scene, threads);
  impl_->buildMs = sinceMs(start);
}

Renderer::~Renderer() = default;

std::string Renderer::device() const { return fmt::format("{}, {} threads", Bvh::version(), threads()); }

int Renderer::threads() const { return impl_->arena.max_concurrency(); }

std::vector<std::string> Renderer::methods() const { return render::methodNames(); }

std::vector<render::EmbreePath> Renderer::embreePaths() const {
  if (!hasPacketInstructions()) return {render::EmbreePath::scalar};
  return {render::EmbreePath::packet, render::EmbreePath::scalar};
}

bool Renderer::updateScene() {
  if (render::findGeometryNeeds(*impl_->source) != impl_->needs) return false;
  render::updateSurfaces(*impl_->source, impl_->scene);
  impl_->order = ShadingOrder(impl_->scene);
  return true;
}

namespace {
// Reserves memory and maps its pages by all threads. The zeros that a vector starts with would map them one after the
// other, which takes 0.4 ms per MiB.
void reserveMapped(std::vector<float>& values, std::size_t count, tbb::task_arena& arena) {
  values.reserve(count);
#ifdef MADV_POPULATE_WRITE
  constexpr std::uintptr_t kPart = std::uintptr_t{1} << 22u;
  const auto begin = reinterpret_cast<std::uintptr_t>(values.data()), end = begin + count * sizeof(float);
  const std::uintptr_t first = (begin + kPart - 1) / kPart, last = end / kPart;  // parts inside the memory
  if (first >= last) return;
  arena.execute([&] {
    tbb::parallel_for(first, last, [&](std::uintptr_t part) {
      // A kernel before Linux 5.14 refuses, which is harmless.
      ::madvise(reinterpret_cast<void*>(part * kPart), kPart,
                MADV_POPULATE_WRITE);  // NOLINT(performance-no-int-to-ptr)
    });
  });
#endif
}

// An image to render, with what its tiles need.
struct PreparedImage {
  PreparedImage(const pack::Scene& source, const Bvh& bvh, const render::RenderScene& scene, std::string_view name,
                const render::RenderParameters& parameters, tbb::task_arena& arena)
      : camera(render::makeCameraParameters(source, parameters)) {
    const bool stokes = render::hasStokes(render::methodNamed(name), parameters);
    result.width = parameters.region.width;
    result.height = parameters.region.height;
    result.channels = stokes ? render::kStokesChannels : render::kColourChannels;
    const std::size_t count = result.channels * result.width * result.height;
    reserveMapped(result.pixels, count, arena);
    result.pixels.resize(count);
    tile = {
        &bvh, &scene, &camera, 0, 0, 0, 0, result.pixels.data(), stokes, render::compiledEffects(source, parameters)};
  }
  PreparedImage(const PreparedImage&) = delete;
  PreparedImage& operator=(const PreparedImage&) = delete;

  gpu::CameraParameters camera;
  render::RenderResult result;
  TileInput tile{};
};
}  // namespace

render::RenderResult Renderer::render(std::string_view name, const render::RenderParameters& parameters) {
  PreparedImage image(*impl_->source, *impl_->bvh, impl_->scene, name, parameters, impl_->arena);
  const std::uint32_t effects = image.tile.effects;
  const bool scalar = tracesSingleRays(parameters);
  image.result.device = device();
  image.result.embreePath = scalar ? render::EmbreePath::scalar : render::EmbreePath::packet;

  const auto start = Clock::now();
  if (scalar) {
    const Method& method = findBuild(allMethods(), name, parameters.checkNumerics ? kEveryEffect : effects);
    const auto renderTile = parameters.checkNumerics ? method.renderTileChecked : method.renderTile;
    renderTiles(image.tile, impl_->arena, kTileSide, kTileSide, image.result, renderTile);
  } else {
    const PacketMethod& method = findBuild(allPacketMethods(), name, effects);
    tbb::enumerable_thread_specific<PacketMemory> memory([&] { return PacketMemory(impl_->order); });
    renderTiles(image.tile, impl_->arena, kPacketTileWidth, kPacketTileHeight, image.result,
                [&](const TileInput& tile) { return method.renderTile(tile, impl_->order, memory.local()); });
  }
  image.result.cost.traceMs = image.result.cost.wallMs = sinceMs(start);
  image.result.cost.buildMs = impl_->buildMs;
  return std::move(image.result);
}

RayLog Renderer::logRays(std::string_view name, const render::RenderParameters& parameters) {
  PreparedImage image(*impl_->source, *impl_->bvh, impl_->scene, name, parameters, impl_->arena);
  const Method& method = findBuild(allMethods(), name, kEveryEffect);
  // A log per tile, so that the order does not depend on the threads.
  std::map<std::pair<std::uint32_t, std::uint32_t>, RayLog> logs;
  std::mutex merging;
  renderTiles(image.tile, impl_->arena, kTileSide, kTileSide, image.result, [&](TileInput tile) {
    RayLog log;
    tile.log = &log;
    const TileOutput output = method.renderTileChecked(tile);
    const std::scoped_lock lock(merging);
    logs[{tile.beginY, tile.beginX}] = std::move(log);
    return output;
  });
  RayLog all;
  for (auto& [tile, log] : logs) {
    append(all, log);
    log.clear();
  }
  return all;
}

const Bvh& Renderer::bvh() const { return *impl_->bvh; }

}  // namespace malus::embree
