// State of the window that does not change the view: modes of the mouse, the panel, messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "render/viewer/frame_times.h"
#include "render/viewer/input_latency.h"
#include "render/viewer/recorder.h"

namespace malus::viewer {

struct UiState {
  bool flies = false;  // WASD and the mouse move the camera freely
  bool showsPanel = true;
  bool turnsPolarizer = false;  // by itself
  std::size_t editedSide = 0;
  double scale = 1;
  FrameTimes frames;                // of the window
  FrameTimes displayPass, overlay;  // by the clock of the device; empty without one
  InputLatency latency;
  std::string message;  // the last event, such as a saved file
  std::string device;   // of the display
  std::array<char, 256> saveFile{"view.exr"};
  std::array<char, 256> sceneFile{"scene.json"};
  std::array<char, 256> folder{"frames"};
  int recordedFrames = 36;
  Recorder recorder;
  bool asksForSave = false, asksForCopy = false;
  std::uint32_t mouseX = 0, mouseY = 0;  // pixel of the image under the cursor
  bool isOverImage = false;
  bool showsProbe = false;
};

}  // namespace malus::viewer
