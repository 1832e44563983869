// Keys and mouse of the window, outside of the panel.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "render/viewer/glfw_window.h"
#include "render/viewer/session.h"
#include "render/viewer/ui_state.h"

namespace malus::viewer {

// A key of the viewer and what it does, for the list of F1 and VIEW.md.
struct KeyHelp {
  const char *key, *text;
};
const std::vector<KeyHelp>& keyHelp();

class WindowInput {
 public:
  // Registers callbacks, before those of Dear ImGui. All arguments must outlive the object. One object per window.
  WindowInput(GlfwWindow& window, Session& session, UiState& ui);
  WindowInput(const WindowInput&) = delete;
  WindowInput& operator=(const WindowInput&) = delete;

  // Moves the camera of a free flight for the keys that are down. Returns whether it moved.
  bool flyOn(double seconds);
  // Position of the mouse in pixels of the image.
  double mouseX() const { return x_ * window_.pixelScale(); }
  double mouseY() const { return y_ * window_.pixelScale(); }

  // Frames to draw until nothing changes; set by every event.
  std::atomic<int> redraws{3};
  bool showsHelp = false;

 private:
  enum class Drag { none, orbit, pan, look, divider };
  static WindowInput& from(GLFWwindow* window);
  void registerCallbacks();
  void onKey(int key, int modifiers);
  void onButton(int button, int action, int modifiers);
  void onMotion(double x, double y);
  void onWheel(double steps);
  bool isAtDivider() const;
  void stepMethod(int step);

  GlfwWindow& window_;
  Session& session_;
  UiState& ui_;
  Drag drag_ = Drag::none;
  double x_ = 0, y_ = 0;
};

}  // namespace malus::viewer
