// Renders the newest wish in a separate thread, so that the window never waits for an image. A wish is first rendered
// at the share of the resolution that keeps 20 frames per second; if no other one follows within kStillMs, at full
// resolution in bands of rows, between which a newer wish ends it.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "render/viewer/adaptive_resolution.h"
#include "render/viewer/frame_times.h"
#include "render/viewer/pixel_store.h"
#include "render/viewer/published.h"
#include "render/viewer/scene_renderers.h"
#include "render/viewer/wish.h"

namespace malus::viewer {

class RenderThread {
 public:
  static constexpr int kStillMs = 60;  // without a newer wish: the view is still

  // All arguments must outlive the object. notify: called by the thread after each publication.
  RenderThread(const Host& host, const pack::Scene& scene, const render::RendererOptions& options, PixelStores& stores,
               std::vector<pack::Effect> needed, std::function<void()> notify);
  // Ends the thread: within the time of a band of rows, or of a compilation of shaders.
  ~RenderThread();

  // Replaces the wish that waits. Never blocks for longer than a copy.
  void submit(const Wish& wish);
  // Time that the display takes of each frame [ms]: the adaptive resolution leaves it free.
  void setDisplayMs(double ms) { displayMs_ = ms; }
  // The newest images.
  Published published() const;
  // Waits until the wish of this generation or of a later one is shown; complete: at full resolution. Returns false
  // after the limit.
  bool waitFor(std::uint64_t generation, bool complete, int limitMs) const;
  // Text of an error that ended the thread, such as a lost device; empty while it runs.
  std::string failure() const;

 private:
  struct SideTask {
    SideImage image;
    double bandRows = 8;  // per call
    bool shares = false;  // may leave images on the device
  };

  void run();
  bool hasNewer(std::uint64_t generation) const;
  void renderWish(const Wish& wish);
  void prepareSides(const Wish& wish);
  void renderCoarse(const Wish& wish);
  bool renderFine(const Wish& wish);
  bool renderFineSide(const Wish& wish, std::size_t side, SideTask& task);
  render::RenderResult renderRows(std::size_t side, SideTask& task, const render::RenderParameters& parameters,
                                  ImageRows& image);
  void noteSide(std::size_t side, const SideTask& task, const render::RenderResult& result, double fullMs,
                std::uint64_t rays, bool isFull);
  void publish(const Published& next);

  const Host& host_;
  SceneRenderers renderers_;
  PixelStores& stores_;
  std::vector<pack::Effect> needed_;
  std::function<void()> notify_;

  // Of the thread alone.
  AdaptiveResolution resolution_;
  std::array<FrameTimes, 2> times_;
  std::array<bool, 2> areFull_{};  // whether times_ are those of complete images
  std::optional<Wish> prepared_;
  std::array<std::optional<SideTask>, 2> tasks_;  // of prepared_
  Published next_;

  std::atomic<double> displayMs_{0};  // 0: unknown
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::optional<Wish> waiting_;
  Published published_;
  std::string failure_;
  bool isEnding_ = false;
  std::thread thread_;
};

}  // namespace malus::viewer
