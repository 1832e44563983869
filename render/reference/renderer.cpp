#include "render/reference/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "meshprep/base/interrupt.h"
#include "render/embree/embree.h"
#include "render/reference/camera_rays.h"
#include "render/reference/depth_paths.h"
#include "render/reference/scene_data.h"
#include "render/reference/tracer.h"
#include "render/scene/render_scene.h"
#include "shaders/optics/optics.h"

namespace malus::reference {

namespace {

using Clock = std::chrono::steady_clock;

double sinceMs(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Pixels of a tile, whose rays are traced together.
constexpr std::uint32_t kTileWidth = 16, kTileHeight = 16;
static_assert(kTileWidth * kTileHeight == kBatch);

// Writes the channels of a pixel.
void writePixel(const Light& sum, double scale, const render::Analyser& analyser, float* out) {
  for (std::size_t c = 0; c < 3; ++c) {
    const dvec4 s = sum[c] * scale;
    out[c] = static_cast<float>(s[0] * analyser[0] + s[1] * analyser[1] + s[2] * analyser[2] + s[3] * analyser[3]);
    for (std::size_t k = 0; k < 4; ++k) out[3 + 3 * k + c] = static_cast<float>(s[static_cast<int>(k)]);
  }
}

// A thread's memory.
struct Worker {
  Worker(const SceneAccess& access, const render::RenderParameters& parameters) : tracer(access, parameters) {}
  Tracer tracer;
  std::vector<Ray> rays;
  std::vector<Light> light, sums;
};

// Renders the tile that begins at pixel (beginX, beginY) of the region.
void renderTile(const pack::Camera& camera, const render::RenderParameters& parameters, const CameraRays& rays,
                std::uint32_t beginX, std::uint32_t beginY, Worker& worker, render::RenderResult& result) {
  const render::Region& region = parameters.region;
  const std::uint32_t endX = std::min(beginX + kTileWidth, region.width),
                      endY = std::min(beginY + kTileHeight, region.height);
  const std::uint32_t samples = parameters.samples;
  const std::size_t pixels = std::size_t{endX - beginX} * (endY - beginY);
  worker.sums.assign(pixels, unpolarized(dvec3(0)));
  worker.light.resize(pixels);
  for (std::uint32_t sample = 0; sample < samples * samples; ++sample) {
    const std::uint32_t column = sample % samples, row = sample / samples;
    worker.rays.clear();
    for (std::uint32_t y = beginY; y < endY; ++y)
      for (std::uint32_t x = beginX; x < endX; ++x) {
        const std::uint32_t pixelX = region.x + x, pixelY = region.y + y;
        const double imageX = (pixelX + (column + 0.5) / samples) / parameters.width,
                     imageY = (pixelY + (row + 0.5) / samples) / parameters.height;
        const dvec3 origin = rays.origin(imageX, imageY);
        worker.rays.push_back({origin, rays.direction(imageX, imageY), glm::vec3(origin), pixelX, pixelY, false,
                               f64::pathStart(pixelX * samples + column, pixelY * samples + row)});
      }
    worker.tracer.trace(worker.rays, parameters.depth, worker.light);
    // The camera frame of a ray: x is the s direction of a surface whose normal is `up`.
    for (std::size_t i = 0; i < pixels; ++i) {
      const dvec3& d = worker.rays[i].d;
      worker.sums[i] = worker.sums[i] + rotated(toSurface(d, f64::sDirection(d, camera.up)), worker.light[i]);
    }
  }
  const double scale = camera.mediumEta * camera.mediumEta / (static_cast<double>(samples) * samples);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t x = beginX + i % (endX - beginX), y = beginY + i / (endX - beginX);
    writePixel(worker.sums[i], scale, parameters.analyser,
               result.pixels.data() + (y * region.width + x) * result.channels);
  }
}

}  // namespace

struct Renderer::Impl {
  Impl(const pack::Scene& scene, unsigned threads) : data(scene, threads) {
    if (threads > 0) arena.emplace(static_cast<int>(threads));
  }

  SceneData data;
  std::optional<tbb::task_arena> arena;  // one for every image; none: that of the caller
  double buildMs = 0;
};

Renderer::Renderer(const pack::Scene& scene, unsigned threads) {
  const auto start = Clock::now();
  impl_ = std::make_unique<Impl>(scene, threads);
  impl_->buildMs = sinceMs(start);
}

Renderer::~Renderer() = default;

bool Renderer::updateScene() { return impl_->data.update(); }

std::string Renderer::device() const { return fmt::format("double precision on {}", embree::Bvh::version()); }

render::RenderResult Renderer::render(std::string_view /*method*/, const render::RenderParameters& parameters) {
  const pack::Scene& scene = impl_->data.scene();
  const auto start = Clock::now();
  render::RenderResult result;
  result.width = parameters.region.width;
  result.height = parameters.region.height;
  result.channels = render::kStokesChannels;
  result.pixels.resize(result.channels * result.width * result.height);
  result.device = device();
  const SceneAccess access = impl_->data.access(parameters);
  const CameraRays cameraRays(scene.camera, parameters.width, parameters.height);
  const std::uint32_t columns = (result.width + kTileWidth - 1) / kTileWidth,
                      rows = (result.height + kTileHeight - 1) / kTileHeight;
  tbb::enumerable_thread_specific<Worker> workers([&] { return Worker(access, parameters); });
  const auto traceAll = [&] {
    tbb::parallel_for(std::uint32_t{0}, columns * rows, [&](std::uint32_t tile) {
      if (interrupted()) return;
      renderTile(scene.camera, parameters, cameraRays, tile % columns * kTileWidth, tile / columns * kTileHeight,
                 workers.local(), result);
    });
  };
  if (impl_->arena)
    impl_->arena->execute(traceAll);
  else
    traceAll();
  if (interrupted()) throw Interrupted();

  result.cost.buildMs = impl_->buildMs;
  result.cost.traceMs = result.cost.wallMs = sinceMs(start);
  for (const Worker& worker : workers) {
    result.cost.rays += worker.tracer.rays;
    result.faults.add(worker.tracer.faults, parameters.width);
  }
  return result;
}

bake::DepthProbe Renderer::probeDepth() {
  const auto start = Clock::now();
  constexpr std::uint32_t kSide = 32;
  const pack::Scene& scene = impl_->data.scene();
  const std::uint32_t height = std::clamp(kSide * scene.height / scene.width, 1u, kSide);
  render::RenderParameters parameters = render::defaultParameters(scene);
  parameters.width = kSide;
  parameters.height = height;
  const SceneAccess access = impl_->data.access(parameters);
  const CameraRays cameraRays(scene.camera, scene.width, scene.height);
  struct Row {
    std::vector<double> energy;
    std::vector<bool> darkBacks;
    std::uint64_t rays, unfollowed;
    std::vector<double> pixels;
    std::set<bake::BlockedLight> blockedLights;
  };
  std::vector<Row> rows(height);
  tbb::parallel_for(std::uint32_t{0}, height, [&](std::uint32_t y) {
    DepthPaths paths(access);
    std::vector<double> pixels(kSide);
    const double basicToRadiance = scene.camera.mediumEta * scene.camera.mediumEta;
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const double imageX = (x + 0.5) / kSide, imageY = (y + 0.5) / height;
      pixels[x] =
          basicToRadiance * paths.followPixel(cameraRays.origin(imageX, imageY), cameraRays.direction(imageX, imageY));
    }
    rows[y] = {paths.energy, paths.darkBacks, paths.rays, paths.unfollowed, std::move(pixels), paths.blockedLights};
  });

  // Add up in the order of the rows, so that the sums do not depend on the threads.
  bake::DepthProbe probe;
  std::vector<double> energy(rows[0].energy.size());
  std::vector<bool> darkBacks(scene.materials.size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < energy.size(); ++i) energy[i] += row.energy[i];
    for (std::size_t i = 0; i < darkBacks.size(); ++i) darkBacks[i] = darkBacks[i] || row.darkBacks[i];
    probe.blockedLights.insert(row.blockedLights.begin(), row.blockedLights.end());
    probe.rays += row.rays;
    probe.unfollowed += row.unfollowed;
    probe.pixelRadiance.insert(probe.pixelRadiance.end(), row.pixels.begin(), row.pixels.end());
  }
  probe.beyond = sharesBeyond(energy);
  for (std::uint32_t i = 0; i < darkBacks.size(); ++i)
    if (darkBacks[i] && scene.materials[i].radiance != dvec3(0.0)) probe.darkEmitters.push_back(i);
  probe.milliseconds = sinceMs(start);
  return probe;
}

render::RenderResult render(const pack::Scene& scene, const render::RenderParameters& parameters, unsigned threads) {
  return Renderer(scene, threads).render("", parameters);
}

}  // namespace malus::reference
