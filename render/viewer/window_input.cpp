#include "render/viewer/window_input.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <glm/geometric.hpp>

#include "render/scene/methods.h"
#include "render/viewer/fly_camera.h"
#include "render/viewer/orbit_camera.h"

namespace malus::viewer {

namespace {

constexpr int kFramesPerEvent = 3;         // the panel needs some frames to follow an event
constexpr double kDegreesPerHeight = 180;  // of a drag over the height of the window
constexpr double kZoomPerStep = 1.1;
constexpr double kTurnDegrees = 5, kFineTurnDegrees = 1;

double wrapped(double degrees) { return degrees - 180 * std::floor(degrees / 180); }

}  // namespace

const std::vector<KeyHelp>& keyHelp() {
  static const std::vector<KeyHelp> kKeys = {
      {"drag", "orbit; in free flight look around"},
      {"right drag, shift + drag", "move the camera sideways"},
      {"wheel", "zoom"},
      {"drag the divider", "move the split"},
      {"F", "free flight on and off: W A S D, Q and E down and up"},
      {"P", "polarizer on and off"},
      {"[ ]", "turn the polarizer by 5 degrees, with shift by 1"},
      {"control + wheel", "turn the polarizer"},
      {"M, shift + M", "next and previous method"},
      {"B", "split on and off"},
      {"X", "exchange the sides"},
      {"1 to 8", "show colour, DoLP, AoLP, S1, S2, S3, difference, FLIP"},
      {"I", "probe of the pixel under the cursor on and off"},
      {"R", "reference in the background on and off"},
      {"- =", "exposure down and up by half a stop"},
      {"Home", "camera of the scene"},
      {"control + S", "save the image"},
      {"control + C", "copy the command line"},
      {"H", "hide and show the panel"},
      {"F1", "this list"},
      {"control + Q", "close"},
  };
  return kKeys;
}

WindowInput::WindowInput(GlfwWindow& window, Session& session, UiState& ui)
    : window_(window), session_(session), ui_(ui) {
  glfwSetWindowUserPointer(window.get(), this);
  registerCallbacks();
}

WindowInput& WindowInput::from(GLFWwindow* window) {
  auto& input = *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
  input.redraws = kFramesPerEvent;
  input.ui_.latency.receive(std::chrono::steady_clock::now());
  return input;
}

void WindowInput::registerCallbacks() {
  GLFWwindow* const window = window_.get();
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
    WindowInput& input = from(w);
    if (action != GLFW_RELEASE && !ImGui::GetIO().WantTextInput) input.onKey(key, modifiers);
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
    from(w).onButton(button, action, modifiers);
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { from(w).onMotion(x, y); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double steps) {
    WindowInput& input = from(w);
    if (!ImGui::GetIO().WantCaptureMouse) input.onWheel(steps);
  });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { from(w); });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { from(w); });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { from(w); });
}

bool WindowInput::isAtDivider() const {
  if (!session_.state.isSplit) return false;
  const double distance = mouseX() - session_.state.divider * session_.width();
  return std::abs(distance) <= 8 * ui_.scale;
}

void WindowInput::onButton(int button, int action, int modifiers) {
  if (action == GLFW_RELEASE) {
    drag_ = Drag::none;
    return;
  }
  if (ImGui::GetIO().WantCaptureMouse) return;
  const bool isSecond = button != GLFW_MOUSE_BUTTON_LEFT || (modifiers & GLFW_MOD_SHIFT) != 0;
  drag_ = isAtDivider() ? Drag::divider : isSecond ? Drag::pan : ui_.flies ? Drag::look : Drag::orbit;
}

void WindowInput::onMotion(double x, double y) {
  const double scale = window_.pixelScale(), height = std::max(1u, session_.height());
  const double dx = (x - x_) * scale / height, dy = (y - y_) * scale / height;
  x_ = x;
  y_ = y;
  ViewState& state = session_.state;
  switch (drag_) {
    case Drag::none:
      break;
    case Drag::orbit:  // the scene follows the mouse
      orbit(state.camera, state.pivot, -kDegreesPerHeight * dx, kDegreesPerHeight * dy);
      break;
    case Drag::pan:
      pan(state.camera, state.pivot, -dx, dy);
      break;
    case Drag::look:
      look(state.camera, -0.5 * kDegreesPerHeight * dx, 0.5 * kDegreesPerHeight * dy);
      state.pivot = pivotAhead(state.camera, glm::length(state.pivot - state.camera.position));
      break;
    case Drag::divider:
      state.divider = std::clamp(mouseX() / std::max(1u, session_.width()), 0.0, 1.0);
      break;
  }
}

void WindowInput::onWheel(double steps) {
  ViewState& state = session_.state;
  const bool control = glfwGetKey(window_.get(), GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
                       glfwGetKey(window_.get(), GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
  if (control) {
    state.filter.kind = FilterKind::linear;
    state.filter.polarizerDegrees = wrapped(state.filter.polarizerDegrees + kTurnDegrees * steps);
    return;
  }
  zoom(state.camera, state.pivot, std::pow(kZoomPerStep, steps));
}

void WindowInput::stepMethod(int step) {
  std::string& method = session_.state.sides[ui_.editedSide].method;
  const std::vector<std::string> names = render::methodNames();
  const auto count = static_cast<int>(names.size());
  const auto at = static_cast<int>(std::ranges::find(names, method) - names.begin());
  method = names[static_cast<std::size_t>((at + step + count) % count)];
}

void WindowInput::onKey(int key, int modifiers) {
  ViewState& state = session_.state;
  const bool shift = (modifiers & GLFW_MOD_SHIFT) != 0, control = (modifiers & GLFW_MOD_CONTROL) != 0;
  const double turn = shift ? kFineTurnDegrees : kTurnDegrees;
  if (control) {
    if (key == GLFW_KEY_S) ui_.asksForSave = true;
    if (key == GLFW_KEY_C) ui_.asksForCopy = true;
    if (key == GLFW_KEY_Q) glfwSetWindowShouldClose(window_.get(), GLFW_TRUE);
    return;
  }
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_8) {
    state.shown = static_cast<Quantity>(key - GLFW_KEY_1);
    const bool compares = state.shown == Quantity::difference || state.shown == Quantity::flip;
    if (compares && state.against == Against::reference) state.usesReference = true;
  }
  switch (key) {
    case GLFW_KEY_F:
      ui_.flies = !ui_.flies;
      break;
    case GLFW_KEY_P:
      state.filter.kind = state.filter.kind == FilterKind::none ? FilterKind::linear : FilterKind::none;
      break;
    case GLFW_KEY_LEFT_BRACKET:
    case GLFW_KEY_RIGHT_BRACKET:
      state.filter.kind = FilterKind::linear;
      state.filter.polarizerDegrees =
          wrapped(state.filter.polarizerDegrees + (key == GLFW_KEY_RIGHT_BRACKET ? turn : -turn));
      break;
    case GLFW_KEY_M:
      stepMethod(shift ? -1 : 1);
      break;
    case GLFW_KEY_B:
      state.isSplit = !state.isSplit;
      if (!state.isSplit) ui_.editedSide = 0;
      break;
    case GLFW_KEY_X:
      std::swap(state.sides[0], state.sides[1]);
      break;
    case GLFW_KEY_I:
      ui_.showsProbe = !ui_.showsProbe;
      break;
    case GLFW_KEY_R:
      state.usesReference = !state.usesReference;
      break;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_EQUAL:
      state.exposureEv += key == GLFW_KEY_EQUAL ? 0.5 : -0.5;
      break;
    case GLFW_KEY_HOME:
      session_.resetCamera();
      break;
    case GLFW_KEY_H:
      ui_.showsPanel = !ui_.showsPanel;
      break;
    case GLFW_KEY_F1:
      showsHelp = !showsHelp;
      break;
    default:
      break;
  }
}

bool WindowInput::flyOn(double seconds) {
  if (!ui_.flies || ImGui::GetIO().WantTextInput) return false;
  const auto axis = [&](int plus, int minus) {
    return int{glfwGetKey(window_.get(), plus) == GLFW_PRESS} - int{glfwGetKey(window_.get(), minus) == GLFW_PRESS};
  };
  const int forward = axis(GLFW_KEY_W, GLFW_KEY_S), right = axis(GLFW_KEY_D, GLFW_KEY_A),
            up = axis(GLFW_KEY_E, GLFW_KEY_Q);
  if (forward == 0 && right == 0 && up == 0) return false;
  // The distance to the pivot per two seconds.
  ViewState& state = session_.state;
  const double distance = glm::length(state.pivot - state.camera.position), step = 0.5 * distance * seconds;
  fly(state.camera, forward * step, right * step, up * step);
  state.pivot = pivotAhead(state.camera, distance);
  return true;
}

}  // namespace malus::viewer
