// A view and what follows from it: the images of the render thread for the newest state. The window and the headless
// run share it.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/viewer/background.h"
#include "render/viewer/device_stores.h"
#include "render/viewer/display_pass.h"
#include "render/viewer/module.h"
#include "render/viewer/render_thread.h"
#include "render/viewer/view_command.h"
#include "render/viewer/wish.h"

namespace malus::viewer {

class Session {
 public:
  // request, host and device must outlive the object. notify: called by threads when there are new images.
  Session(const Request& request, const Host& host, const DisplayDevice& device, const std::function<void()>& notify);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  ViewState state;

  // Submits the state for a window of this size, if it needs new images. Returns the generation of the images. Throws
  // Error if the render thread has ended with one.
  std::uint64_t update(std::uint32_t width, std::uint32_t height);
  const RenderThread& renders() const { return renders_; }
  // Time of the display pass of a frame [ms].
  void addDisplayMs(double ms) {
    displayTimes_.add(ms);
    renders_.setDisplayMs(displayTimes_.median());
  }
  // Gives the background what the newest images need: reference, errors. Returns whether something waits for the view
  // to be still.
  bool updateBackground(const Published& published);
  // The camera and the pivot of the start.
  void resetCamera() {
    state.camera = request_.state.camera;
    state.pivot = request_.state.pivot;
  }
  void probe(std::uint32_t x, std::uint32_t y);
  BackgroundState background() const { return background_.state(); }
  DisplayInput input(const Published& published) const;
  const Wish& wish() const { return *wish_; }
  std::uint64_t generation() const { return wish_ ? wish_->generation : 0; }
  std::uint32_t width() const { return wish_ ? wish_->width : 0; }
  std::uint32_t height() const { return wish_ ? wish_->height : 0; }

  const pack::Pack& pack() const { return *request_.pack; }
  // Name, origin and hash of the pack with the camera of the view, for the metadata of files.
  pack::Pack viewedPack() const;
  const std::vector<pack::Effect>& effects() const { return file_.needed; }
  const ViewedFile& file() const { return file_; }
  // The command that renders what a side shows.
  std::string command(std::size_t side, const std::string& output) const;

 private:
  const Request& request_;
  ViewedFile file_;
  DeviceStores stores_;
  std::optional<Wish> wish_;
  RenderThread renders_;
  Background background_;
  FrameTimes displayTimes_;
  std::string errorKey_;  // of the newest request, and when it changed
  std::chrono::steady_clock::time_point errorKeyChanged_;
  bool isErrorRequested_ = false;
};

}  // namespace malus::viewer
