#include "render/viewer/glfw_window.h"

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::viewer {

namespace {

std::string lastProblem() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

}  // namespace

Glfw::Glfw() {
  if (!glfwInit())
    throw Error("", fmt::format("cannot open a window ({})", lastProblem()),
                "a display (DISPLAY or WAYLAND_DISPLAY), or --frames N for a run without a window");
}
Glfw::~Glfw() { glfwTerminate(); }

std::vector<const char*> Glfw::extensions() const {
  std::uint32_t count = 0;
  const char** const names = glfwVulkanSupported() ? glfwGetRequiredInstanceExtensions(&count) : nullptr;
  if (!names)
    throw Error("", "Vulkan cannot draw on this display", "a Vulkan driver, such as mesa-vulkan-drivers",
                lastProblem());
  return {names, names + count};
}

GlfwWindow::GlfwWindow(std::uint32_t width, std::uint32_t height, const std::string& title) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  window_ = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(), nullptr, nullptr);
  if (!window_)
    throw Error("", fmt::format("cannot open a window ({})", lastProblem()), "--frames N for a run without");
}
GlfwWindow::~GlfwWindow() { glfwDestroyWindow(window_); }

void GlfwWindow::size(std::uint32_t& width, std::uint32_t& height) const {
  int w = 0, h = 0;
  glfwGetFramebufferSize(window_, &w, &h);
  width = static_cast<std::uint32_t>(w);
  height = static_cast<std::uint32_t>(h);
}

double GlfwWindow::pixelScale() const {
  int pixels = 0, units = 0, ignored = 0;
  glfwGetFramebufferSize(window_, &pixels, &ignored);
  glfwGetWindowSize(window_, &units, &ignored);
  return units > 0 ? static_cast<double>(pixels) / units : 1;
}

double GlfwWindow::uiScale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return static_cast<double>(x);
}

vulkan::OwnedChild<VkInstance, VkSurfaceKHR> makeSurface(VkInstance instance, const GlfwWindow& window) {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  vulkan::check(glfwCreateWindowSurface(instance, window.get(), nullptr, &surface), "glfwCreateWindowSurface");
  return {instance, surface, vkDestroySurfaceKHR};
}

}  // namespace malus::viewer
