// A view and what follows from it: the images of the render thread for the newest state. The window and the headless
// run share it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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
  DisplayInput input() const;
  std::uint64_t generation() const { return wish_ ? wish_->generation : 0; }
  std::uint32_t width() const { return wish_ ? wish_->width : 0; }
  std::uint32_t height() const { return wish_ ? wish_->height : 0; }

  const pack::Pack& pack() const { return *request_.pack; }
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
};

}  // namespace malus::viewer
