#include "render/embree/renderer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "render/embree/methods.h"
#include "render/embree/tile.h"
#include "render/scene/compiled_effects.h"
#include "render/scene/methods.h"
#include "render/scene/render_scene.h"

namespace malus::embree {
using Clock = std::chrono::steady_clock;

namespace {
double sinceMs(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}
constexpr std::size_t kTileSide = 16;

// Returns the first build of a method that contains all effects and, if asked for, the numeric checks.
const Method& findBuild(std::string_view name, std::uint32_t effects, bool checks) {
  const Method* found = nullptr;
  for (const Method* m : allMethods())
    if (m->name == name && (effects & ~m->effects) == 0 && (!checks || m->renderTileChecked) && !found) found = m;
  return *found;  // the last build contains every effect and the checks
}
}  // namespace

struct Renderer::Impl {
  pack::Scene const* source;
  render::RenderScene scene;
  int threads;
  double buildMs = 0;
  std::unique_ptr<Bvh> bvh;
};

Renderer::Renderer(const pack::Scene& scene, unsigned threads) : impl_(std::make_unique<Impl>()) {
  const auto start = Clock::now();
  impl_->source = &scene;
  impl_->scene = render::makeRenderScene(scene);
  impl_->threads = static_cast<int>(threads == 0 ? std::max(1u, std::thread::hardware_concurrency()) : threads);
  impl_->bvh = std::make_unique<Bvh>(impl_->scene, threads);
  impl_->buildMs = sinceMs(start);
}

Renderer::~Renderer() = default;

std::string Renderer::device() const { return fmt::format("{}, {} threads", Bvh::version(), impl_->threads); }

std::vector<std::string> Renderer::methods() const { return render::methodNames(); }

render::RenderResult Renderer::render(std::string_view name, const render::RenderParameters& parameters) {
  const render::MethodInfo& info = render::methodNamed(name);
  const Method& method = findBuild(name, render::compiledEffects(*impl_->source, parameters), parameters.checkNumerics);

  render::RenderResult result;
  result.width = parameters.region.width;
  result.height = parameters.region.height;
  result.channels = render::hasStokes(info, parameters) ? render::kStokesChannels : render::kColourChannels;
  result.pixels.resize(result.channels * result.width * result.height);
  result.device = device();
  const gpu::CameraParameters camera = render::makeCameraParameters(*impl_->source, parameters);

  const auto start = Clock::now();
  std::atomic<std::uint64_t> rays{0};
  std::mutex merging;
  tbb::task_arena arena(impl_->threads);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range2d<std::uint32_t>(0, parameters.region.height, kTileSide, 0,
                                                          parameters.region.width, kTileSide),
                      [&](const tbb::blocked_range2d<std::uint32_t>& r) {
                        const auto renderTile = parameters.checkNumerics ? method.renderTileChecked : method.renderTile;
                        const TileOutput tile = renderTile({impl_->bvh.get(), &impl_->scene, &camera, r.cols().begin(),
                                                            r.rows().begin(), r.cols().end(), r.rows().end(),
                                                            result.pixels.data(), render::hasStokes(info, parameters)});
                        rays += tile.rays;
                        if (tile.faults.count == 0) return;
                        const std::scoped_lock lock(merging);
                        result.faults.add(tile.faults, camera.width);
                      });
  });
  result.cost.traceMs = result.cost.wallMs = sinceMs(start);
  result.cost.buildMs = impl_->buildMs;
  result.cost.rays = rays;
  return result;
}

}  // namespace malus::embree
