#include "render/viewer/render_thread.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/scene/methods.h"

namespace malus::viewer {
using Clock = std::chrono::steady_clock;

namespace {

// Time of a band of the full image: a newer wish waits for it.
constexpr double kBandMs = 12;

double elapsedMs(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::uint32_t scaled(std::uint32_t side, double fraction) {
  return std::max(1u, static_cast<std::uint32_t>(std::lround(side * fraction)));
}

render::RendererOptions withSharedPixels(render::RendererOptions options) {
  options.sharesPixels = true;
  return options;
}

std::string pathName(const render::RenderResult& result) {
  if (result.vulkanPath != render::VulkanPath::automatic) return render::vulkanPathName(result.vulkanPath);
  if (result.embreePath != render::EmbreePath::automatic) return render::embreePathName(result.embreePath);
  return {};
}

}  // namespace

RenderThread::RenderThread(const Host& host, const pack::Scene& scene, const render::RendererOptions& options,
                           PixelStores& stores, std::vector<pack::Effect> needed, std::function<void()> notify)
    : host_(host),
      renderers_(host, scene, withSharedPixels(options)),
      stores_(stores),
      needed_(std::move(needed)),
      notify_(std::move(notify)),
      thread_([this] { run(); }) {}

RenderThread::~RenderThread() {
  {
    const std::scoped_lock lock(mutex_);
    isEnding_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RenderThread::submit(const Wish& wish) {
  {
    const std::scoped_lock lock(mutex_);
    waiting_ = wish;
  }
  changed_.notify_all();
}

Published RenderThread::published() const {
  const std::scoped_lock lock(mutex_);
  return published_;
}

std::string RenderThread::failure() const {
  const std::scoped_lock lock(mutex_);
  return failure_;
}

bool RenderThread::waitFor(std::uint64_t generation, bool complete, int limitMs) const {
  std::unique_lock lock(mutex_);
  const auto isShown = [&] {
    return !failure_.empty() || (published_.generation >= generation && (published_.isComplete || !complete));
  };
  return changed_.wait_for(lock, std::chrono::milliseconds(limitMs), isShown) && failure_.empty();
}

bool RenderThread::hasNewer(std::uint64_t generation) const {
  const std::scoped_lock lock(mutex_);
  return isEnding_ || (waiting_ && waiting_->generation != generation);
}

void RenderThread::publish(const Published& next) {
  {
    const std::scoped_lock lock(mutex_);
    published_ = next;
  }
  changed_.notify_all();
  notify_();
}

void RenderThread::run() {
  try {
    for (;;) {
      Wish wish;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return isEnding_ || waiting_; });
        if (isEnding_) return;
        wish = *std::exchange(waiting_, std::nullopt);
      }
      renderWish(wish);
    }
  } catch (const Interrupted&) {  // the window ends by itself
  } catch (const std::exception& error) {
    const std::scoped_lock lock(mutex_);
    failure_ = error.what();
  }
  changed_.notify_all();
  notify_();
}

void RenderThread::renderWish(const Wish& wish) {
  next_.generation = wish.generation;
  next_.isComplete = false;
  // A choice of effects looks at the whole scene, which takes some milliseconds: not while only the camera moves.
  if (!prepared_ || !isSamePreparation(*prepared_, wish, needed_)) prepareSides(wish);
  prepared_ = wish;
  if (!tasks_[0] && !tasks_[1]) {
    next_.isComplete = true;
    publish(next_);
    return;
  }
  renderCoarse(wish);
  if (next_.isComplete && !wish.state.isContinuous) return;
  {
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, std::chrono::milliseconds(kStillMs), [&] { return isEnding_ || waiting_; })) return;
  }
  do
    if (!renderFine(wish)) return;
  while (wish.state.isContinuous && !hasNewer(wish.generation));
}

// Sides that cannot be rendered, for example because of an effect that cannot be removed, keep their image and get the
// reason.
void RenderThread::prepareSides(const Wish& wish) {
  tasks_ = {};
  for (std::size_t i = 0; i < 2; ++i) {
    PublishedSide& side = next_.sides[i];
    if (i == 1 && !wish.state.isSplit) {
      side = {};
      continue;
    }
    const SideSettings& settings = wish.state.sides[i];
    times_[i].clear();
    areFull_[i] = false;
    side.problem.clear();
    side.copiedBytes = 0;
    try {
      tasks_[i] = SideTask{renderers_.prepare(jobSettings(wish.state, settings, wish.width, wish.height, needed_))};
    } catch (const Error& error) {
      side.problem = error.what();
      continue;
    }
    tasks_[i]->shares = settings.backend == render::Backend::vulkan;
    side.method = tasks_[i]->image.method;
    side.substitutedFor = tasks_[i]->image.substitutedFor;
    side.warnings = tasks_[i]->image.warnings;
  }
  renderers_.releaseUnused();
}

void RenderThread::noteSide(std::size_t side, const SideTask& task, const render::RenderResult& result, double fullMs,
                            std::uint64_t rays, bool isFull) {
  PublishedSide& published = next_.sides[side];
  // Small images are slower per pixel: they are estimates until an image is complete.
  if (isFull && !areFull_[side]) times_[side].clear();
  if (isFull || !areFull_[side]) times_[side].add(fullMs);
  areFull_[side] = areFull_[side] || isFull;
  published.traceMs = fullMs;
  published.medianMs = times_[side].median();
  published.device = result.device;
  published.path = pathName(result);
  published.rays = rays;
  published.method = task.image.method;
}

// Renders the region, whole rows, and adds it to the image, whose memory is taken with the first rows: on the device
// where the renderer and the display share memory.
render::RenderResult RenderThread::renderRows(std::size_t side, SideTask& task,
                                              const render::RenderParameters& parameters, ImageRows& image) {
  render::Renderer& renderer = *task.image.renderer;
  const render::Region& region = parameters.region;
  const auto begin = [&](std::shared_ptr<PixelStore> store, std::size_t channels) {
    image = {std::move(store), parameters.width, parameters.height, static_cast<std::uint32_t>(channels), 0};
  };
  if (!image.store && task.shares) {
    const std::size_t channels = render::hasStokes(render::methodNamed(task.image.method), parameters)
                                     ? render::kStokesChannels
                                     : render::kColourChannels;
    auto store = stores_.takeShared(channels * parameters.width * parameters.height);
    task.shares = store && renderer.acceptTarget(store->shared());
    if (task.shares) begin(std::move(store), channels);
  }
  PublishedSide& published = next_.sides[side];
  published.isShared = image.store && image.store->shared();
  render::RenderResult result;
  if (published.isShared) {
    result = renderer.renderTo(task.image.method, parameters, *image.store->shared(),
                               std::size_t{image.channels} * image.width * region.y);
  } else {
    result = renderer.render(task.image.method, parameters);
    if (!image.store) begin(stores_.take(result.channels * parameters.width * parameters.height), result.channels);
    std::ranges::copy(result.pixels, image.store->values().begin() +
                                         static_cast<std::ptrdiff_t>(result.channels * image.width * region.y));
    published.copiedBytes += result.pixels.size() * sizeof(float);
  }
  image.rows = region.y + region.height;
  return result;
}

void RenderThread::renderCoarse(const Wish& wish) {
  const double fraction = resolution_.fraction();
  const auto start = Clock::now();
  for (std::size_t i = 0; i < 2; ++i) {
    if (!tasks_[i]) continue;
    SideTask& task = *tasks_[i];
    render::RenderParameters parameters = task.image.parameters;
    parameters.width = scaled(wish.width, fraction);
    parameters.height = scaled(wish.height, fraction);
    parameters.region = {0, 0, parameters.width, parameters.height};
    task.image.scene->camera = wish.state.camera;
    ImageRows image;
    const render::RenderResult result = renderRows(i, task, parameters, image);
    const double share = double(wish.width) * wish.height / (double(result.width) * result.height);
    task.bandRows = std::max(1.0, kBandMs / std::max(result.cost.wallMs * share, 1e-3) * wish.height);
    noteSide(i, task, result, result.cost.traceMs * share,
             static_cast<std::uint64_t>(static_cast<double>(result.cost.rays) * share), fraction == 1);
    next_.sides[i].coarse = fraction < 1 ? image : ImageRows{};
    next_.sides[i].fine = fraction < 1 ? ImageRows{} : image;
  }
  if (displayMs_ > 0) resolution_.setDisplayMs(displayMs_);
  resolution_.add(fraction, elapsedMs(start));
  next_.fraction = fraction;
  next_.isComplete = fraction == 1;
  ++next_.images;
  publish(next_);
}

bool RenderThread::renderFine(const Wish& wish) {
  for (std::size_t i = 0; i < 2; ++i)
    if (tasks_[i] && !renderFineSide(wish, i, *tasks_[i])) return false;
  next_.isComplete = true;
  ++next_.images;
  publish(next_);
  return true;
}

// Returns false if a newer wish ended it.
bool RenderThread::renderFineSide(const Wish& wish, std::size_t side, SideTask& task) {
  PublishedSide& published = next_.sides[side];
  render::RenderParameters parameters = task.image.parameters;
  task.image.scene->camera = wish.state.camera;
  // While the same view is rendered again, the complete image stays visible.
  const bool isHidden = published.fine.isComplete() && published.fine.height == wish.height;
  ImageRows image;
  double traceMs = 0;
  std::uint64_t rays = 0;
  render::RenderResult band;
  for (std::uint32_t row = 0; row < wish.height;) {
    if (hasNewer(wish.generation)) return false;
    const std::uint32_t count =
        std::min(wish.height - row, std::max(1u, static_cast<std::uint32_t>(std::min(task.bandRows, 1e6))));
    parameters.region = {0, row, wish.width, count};
    band = renderRows(side, task, parameters, image);
    row = image.rows;
    traceMs += band.cost.traceMs;
    rays += band.cost.rays;
    task.bandRows *= std::clamp(kBandMs / std::max(band.cost.wallMs, 1e-3), 0.5, 2.0);
    if (row == wish.height) noteSide(side, task, band, traceMs, rays, true);
    if (isHidden && row < wish.height) continue;
    published.fine = image;
    if (row < wish.height) publish(next_);
  }
  return true;
}

}  // namespace malus::viewer
