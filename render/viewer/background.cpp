#include "render/viewer/background.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "render/compare/flip.h"
#include "render/compare/image_error.h"
#include "render/viewer/filtered_colours.h"

namespace malus::viewer {
using Clock = std::chrono::steady_clock;

namespace {

// Time of a tile: a change of the view waits for it.
constexpr double kTileMs = 20;

double elapsedMs(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

Background::Background(const Host& host, const pack::Scene& scene, const render::RendererOptions& options,
                       PixelStores& stores, std::vector<pack::Effect> needed, std::function<void()> notify)
    : host_(host),
      renderers_(host, scene, options),
      truthScene_(scene),
      stores_(stores),
      needed_(std::move(needed)),
      notify_(std::move(notify)),
      thread_([this] { run(); }) {}

Background::~Background() {
  {
    const std::scoped_lock lock(mutex_);
    isEnding_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Background::setView(const Wish& wish) {
  const std::scoped_lock lock(mutex_);
  if (view_ && view_->generation == wish.generation) return;
  view_ = wish;
  errorWish_.reset();
  pixelWish_.reset();
  state_ = {};
  state_.generation = wish.generation;
}

void Background::requestReference(bool isWanted) {
  {
    const std::scoped_lock lock(mutex_);
    if (wantsReference_ == isWanted) return;
    wantsReference_ = isWanted;
  }
  changed_.notify_all();
}

void Background::requestErrors(const ErrorWish& wish) {
  {
    const std::scoped_lock lock(mutex_);
    errorWish_ = wish;
  }
  changed_.notify_all();
}

void Background::requestPixel(const PixelWish& wish) {
  {
    const std::scoped_lock lock(mutex_);
    if (state_.truth && state_.pixel == wish) return;
    pixelWish_ = wish;
  }
  changed_.notify_all();
}

BackgroundState Background::state() const {
  const std::scoped_lock lock(mutex_);
  return state_;
}

bool Background::isStale(std::uint64_t generation) const {
  const std::scoped_lock lock(mutex_);
  return isEnding_ || pixelWish_ || !view_ || view_->generation != generation || !wantsReference_;
}

// Under the lock.
bool Background::hasWork() const {
  if (isEnding_ || pixelWish_) return true;
  if (!view_ || !state_.problem.empty()) return false;
  if (wantsReference_ && !state_.reference.isComplete()) return true;
  return errorWish_ && (state_.reference.isComplete() || errorWish_->againstOther);
}

void Background::run() {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return hasWork(); });
      if (isEnding_) return;
    }
    try {
      work();
    } catch (const Interrupted&) {
      return;  // the window ends by itself
    } catch (const std::exception& error) {
      const std::scoped_lock lock(mutex_);
      state_.problem = error.what();
    }
    notify_();
  }
}

// The shortest work first: the pixel under the cursor, the reference, the errors.
void Background::work() {
  std::unique_lock lock(mutex_);
  if (!view_) return;
  const Wish wish = *view_;
  if (pixelWish_) {
    const PixelWish pixel = *std::exchange(pixelWish_, std::nullopt);
    lock.unlock();
    findTruth(wish, pixel);
    return;
  }
  if (wantsReference_ && !state_.reference.isComplete()) {
    lock.unlock();
    renderReference(wish);
    return;
  }
  const ErrorWish errors = *std::exchange(errorWish_, std::nullopt);
  const ImageRows reference = state_.reference;
  lock.unlock();
  computeErrors(errors, reference);
}

// Continues at the first row that is missing, until it is complete or the view changes.
void Background::renderReference(const Wish& wish) {
  SideSettings side;
  side.backend = render::Backend::reference;
  SideImage image = renderers_.prepare(jobSettings(wish.state, side, wish.width, wish.height, needed_));
  image.scene->camera = wish.state.camera;
  ImageRows rows;
  {
    const std::scoped_lock lock(mutex_);
    rows = state_.reference;
  }
  if (!rows.store)
    rows = {stores_.take(render::kStokesChannels * wish.width * wish.height), wish.width, wish.height,
            render::kStokesChannels, 0};
  while (rows.rows < wish.height && !isStale(wish.generation)) {
    const auto start = Clock::now();
    const auto count = static_cast<std::uint32_t>(std::clamp(tilePixels_ / wish.width, 1.0, 1e6));
    const std::uint32_t next = std::min(count, wish.height - rows.rows);
    ImageRows done = rows;
    renderTiles(wish, image, rows.rows, next, done);
    if (done.rows == rows.rows) return;  // the view has changed
    rows = done;
    {
      const std::scoped_lock lock(mutex_);
      if (!view_ || view_->generation != wish.generation) return;
      state_.reference = rows;
      state_.referenceMs += elapsedMs(start);
    }
    notify_();
  }
}

// Renders some rows in tiles of about kTileMs; their number is added if none was interrupted.
void Background::renderTiles(const Wish& wish, SideImage& image, std::uint32_t row, std::uint32_t rows, ImageRows& to) {
  render::RenderParameters parameters = image.parameters;
  for (std::uint32_t x = 0; x < wish.width;) {
    if (isStale(wish.generation)) return;
    const auto columns = static_cast<std::uint32_t>(std::clamp(tilePixels_ / rows, 1.0, double(wish.width - x)));
    parameters.region = {x, row, columns, rows};
    const auto start = Clock::now();
    const render::RenderResult tile = image.renderer->render({}, parameters);
    tilePixels_ = std::clamp(tilePixels_ * std::clamp(kTileMs / std::max(elapsedMs(start), 1e-3), 0.5, 1.5), 64.0, 1e6);
    const std::span<float> values = to.store->values();
    for (std::uint32_t y = 0; y < rows; ++y)
      std::copy_n(
          tile.pixels.begin() + static_cast<std::ptrdiff_t>(tile.channels * columns * y), tile.channels * columns,
          values.begin() + static_cast<std::ptrdiff_t>(tile.channels * (std::size_t{row + y} * wish.width + x)));
    x += columns;
  }
  to.rows = row + rows;
}

void Background::computeErrors(const ErrorWish& wish, const ImageRows& reference) {
  BackgroundState next;
  std::array<std::optional<render::RenderResult>, 2> images;
  for (std::size_t i = 0; i < 2; ++i)
    if (wish.sides[i].isComplete()) images[i] = filteredColours(wish.sides[i], wish.analyser);
  std::optional<render::RenderResult> truth;
  if (reference.isComplete()) truth = filteredColours(reference, wish.analyser);
  const auto fits = [](const auto& a, const auto& b) {
    return a && b && a->width == b->width && a->height == b->height;
  };
  for (std::size_t i = 0; i < 2; ++i) {
    if (!fits(images[i], truth)) continue;
    const render::ImageError error = render::imageError(*images[i], *truth, wish.exposureEv);
    next.errors[i] = SideError{error.relRms, error.perceptual};
  }
  for (std::size_t i = 0; wish.needsFlipMap && i < 2; ++i) {
    const auto& other = wish.againstOther ? images[1 - i] : truth;
    if (!fits(images[i], other)) continue;
    const std::vector<double> values = render::flipValues(*images[i], *other, wish.exposureEv);
    if (!next.flip) next.flip = stores_.take(2 * values.size());
    std::ranges::transform(values, next.flip->values().begin() + static_cast<std::ptrdiff_t>(i * values.size()),
                           [](double v) { return static_cast<float>(v); });
  }
  const std::scoped_lock lock(mutex_);
  if (!view_ || view_->generation != wish.generation) return;
  state_.errors = next.errors;
  if (next.flip) state_.flip = next.flip;
}

void Background::findTruth(const Wish& wish, const PixelWish& pixel) {
  SideSettings side;
  side.backend = render::Backend::reference;
  render::RenderParameters parameters =
      host_.renderParameters(jobSettings(wish.state, side, wish.width, wish.height, needed_), truthScene_);
  parameters.region = {std::min(pixel.x, wish.width - 1), std::min(pixel.y, wish.height - 1), 1, 1};
  truthScene_.camera = wish.state.camera;
  const render::PixelTruth truth = host_.pixelTruth(truthScene_, parameters);
  const std::scoped_lock lock(mutex_);
  if (!view_ || view_->generation != wish.generation) return;
  state_.pixel = pixel;
  state_.truth = truth;
}

}  // namespace malus::viewer
