// A window of the desktop with a Vulkan surface.
#pragma once

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/vulkan/owned.h"

namespace malus::viewer {

// The windowing library. At most one may exist at a time. Throws Error: no display.
class Glfw {
 public:
  Glfw();
  ~Glfw();
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
  // Instance extensions that surfaces need. Throws Error: no Vulkan driver.
  std::vector<const char*> extensions() const;
};

class GlfwWindow {
 public:
  // Hidden until glfwShowWindow(). Throws Error: the display refuses a window.
  GlfwWindow(std::uint32_t width, std::uint32_t height, const std::string& title);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  GLFWwindow* get() const { return window_; }
  // In pixels; 0 while the window is minimised.
  void size(std::uint32_t& width, std::uint32_t& height) const;
  // Pixels of the image per unit of the mouse's positions.
  double pixelScale() const;
  double uiScale() const;

 private:
  GLFWwindow* window_;
};

vulkan::OwnedChild<VkInstance, VkSurfaceKHR> makeSurface(VkInstance instance, const GlfwWindow& window);

}  // namespace malus::viewer
