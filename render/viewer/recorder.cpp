#include "render/viewer/recorder.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/viewer/orbit_camera.h"

namespace malus::viewer {

void Recorder::start(Recording what, const std::string& folder, std::uint32_t frames, const ViewState& state) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw Error(folder, "cannot make the folder", "a writable place", failed.message());
  what_ = what;
  folder_ = folder;
  frames_ = frames;
  frame_ = 0;
  start_ = state;
  isRecording_ = frames > 0;
}

void Recorder::apply(ViewState& state) const {
  if (!isRecording_) return;
  const double share = static_cast<double>(frame_) / frames_;
  if (what_ == Recording::turntable) {
    state.camera = start_.camera;
    state.pivot = start_.pivot;
    orbit(state.camera, state.pivot, 360 * share, 0);
  } else {
    state.filter = start_.filter;
    state.filter.kind = FilterKind::linear;
    state.filter.polarizerDegrees = 180 * share;
  }
}

std::string Recorder::file() const { return fmt::format("{}/frame-{:03}.png", folder_, frame_); }

void Recorder::next(ViewState& state) {
  if (++frame_ >= frames_) stop(state);
}

void Recorder::stop(ViewState& state) {
  if (!std::exchange(isRecording_, false)) return;
  state.camera = start_.camera;
  state.pivot = start_.pivot;
  state.filter = start_.filter;
}

}  // namespace malus::viewer
