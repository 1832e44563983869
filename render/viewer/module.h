// The interface between the program and the module of the viewer, which is loaded when `malus view` runs: it is linked
// with the windowing library, which other commands do not need.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bake/pack/reader.h"
#include "render/scene/render_parameters.h"
#include "render/viewer/host.h"
#include "render/viewer/view_state.h"

namespace malus::viewer {

struct Request {
  const pack::Pack* pack = nullptr;
  std::string file;  // as on the command line
  ViewState state;   // at the start
  std::uint32_t width = 0, height = 0;
  std::string device;  // as render::RendererOptions::device
  unsigned threads = 0;
  double uiScale = 0;        // of the panel; 0: that of the display
  std::uint32_t frames = 0;  // without a window: number of frames
  std::string script;        // without a window: file (VIEW.md); "": none
  bool json = false;         // print times as JSON at the end
  bool quiet = false;        // print no result
};

struct Module {
  const char* version;  // of the program that it belongs to
  // Runs until the window is closed, or all frames are rendered. Throws Error, Interrupted.
  void (*run)(const Request& request, const Host& host);
};

// Name of the only symbol of malus-viewer.so: extern "C" const Module* malusViewerModule(). Never null.
inline constexpr const char* kModuleEntry = "malusViewerModule";

}  // namespace malus::viewer
