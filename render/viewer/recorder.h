// Records frames into a folder: a turntable around the pivot, or a polarizer that turns by 180 degrees. Each frame is
// saved when its image is complete; the window stays usable.
#pragma once

#include <cstdint>
#include <string>

#include "render/viewer/view_state.h"

namespace malus::viewer {

enum class Recording { turntable, polarizer };

class Recorder {
 public:
  // Makes the folder, if it does not exist. Throws Error: it cannot be made.
  void start(Recording what, const std::string& folder, std::uint32_t frames, const ViewState& state);
  // Ends the recording, and restores the view.
  void stop(ViewState& state);
  bool isRecording() const { return isRecording_; }
  std::uint32_t frame() const { return frame_; }
  std::uint32_t frames() const { return frames_; }

  // Sets the camera or the polarizer of the current frame.
  void apply(ViewState& state) const;
  // File of the current frame: FOLDER/frame-000.png.
  std::string file() const;
  // The current frame is saved. Stops after the last one.
  void next(ViewState& state);

 private:
  Recording what_ = Recording::turntable;
  std::string folder_;
  std::uint32_t frames_ = 0, frame_ = 0;
  ViewState start_;
  bool isRecording_ = false;
};

}  // namespace malus::viewer
