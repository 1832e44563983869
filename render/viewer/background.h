// Work behind the display of a still view: the reference image tile by tile, the errors of the sides, the geometry
// under the cursor. One thread; a change of the view ends the tile at hand and drops the rest.
#pragma once

#include <array>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "render/viewer/published.h"
#include "render/viewer/scene_renderers.h"
#include "render/viewer/wish.h"

namespace malus::viewer {

struct SideError {
  double relRms = 0;  // relative RMS error of the colours behind the filter
  double flip = 0;    // mean FLIP
};

// Inputs of the errors.
struct ErrorWish {
  std::uint64_t generation = 0;
  std::array<ImageRows, 2> sides;  // complete images; an empty one has no error
  render::Analyser analyser = render::kNoFilter;
  double exposureEv = 0;
  bool againstOther = false;  // FLIP of each pixel to the other side, not to the reference
  bool needsFlipMap = false;
};

struct PixelWish {
  std::uint64_t generation = 0;
  std::uint32_t x = 0, y = 0;

  friend bool operator==(const PixelWish&, const PixelWish&) = default;
};

struct BackgroundState {
  std::uint64_t generation = 0;  // of the view that reference and errors belong to
  ImageRows reference;
  double referenceMs = 0;  // so far
  std::array<std::optional<SideError>, 2> errors;
  std::shared_ptr<PixelStore> flip;  // as DisplayInput::flip
  PixelWish pixel;
  std::optional<render::PixelTruth> truth;  // of pixel
  std::string problem;
};

class Background {
 public:
  // Arguments as of RenderThread.
  Background(const Host& host, const pack::Scene& scene, const render::RendererOptions& options, PixelStores& stores,
             std::vector<pack::Effect> needed, std::function<void()> notify);
  ~Background();

  // The view changes, or is not still: work for another generation ends. Call it before the other functions.
  void setView(const Wish& wish);
  void requestReference(bool isWanted);
  void requestErrors(const ErrorWish& wish);
  void requestPixel(const PixelWish& wish);
  BackgroundState state() const;

 private:
  void run();
  bool hasWork() const;
  void work();
  void renderReference(const Wish& wish);
  void renderTiles(const Wish& wish, SideImage& image, std::uint32_t row, std::uint32_t rows, ImageRows& to);
  void computeErrors(const ErrorWish& wish, const ImageRows& reference);
  void findTruth(const Wish& wish, const PixelWish& pixel);
  bool isStale(std::uint64_t generation) const;

  const Host& host_;
  SceneRenderers renderers_;
  pack::Scene truthScene_;
  PixelStores& stores_;
  std::vector<pack::Effect> needed_;
  std::function<void()> notify_;
  double tilePixels_ = 2048;  // of the thread alone

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Wish> view_;
  bool wantsReference_ = false, isEnding_ = false;
  std::optional<ErrorWish> errorWish_;
  std::optional<PixelWish> pixelWish_;
  BackgroundState state_;
  std::thread thread_;
};

}  // namespace malus::viewer
