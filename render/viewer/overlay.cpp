#include "render/viewer/overlay.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>
#if __has_include(<backends/imgui_impl_glfw.h>)
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#else
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>
#endif

namespace malus::viewer {

namespace {

vulkan::Owned<VkDescriptorPool> makePool(VkDevice device) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 16};
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  info.maxSets = 16;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  return vulkan::create(device, vkCreateDescriptorPool, info, vkDestroyDescriptorPool,
                        "vkCreateDescriptorPool (panel)");
}

void checkResult(VkResult result) { vulkan::check(result, "Dear ImGui"); }

void initialize(VkInstance instance, const DisplayDevice& device, const Swapchain& swapchain, VkDescriptorPool pool) {
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = instance;
  info.PhysicalDevice = device.physical();
  info.Device = device.get();
  info.QueueFamily = device.queueFamily();
  info.Queue = device.queue();
  info.DescriptorPool = pool;
  info.MinImageCount = 2;
  info.ImageCount = std::max(2u, swapchain.imageCount());
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = checkResult;
#if IMGUI_VERSION_NUM >= 19030
  info.RenderPass = swapchain.renderPass();
  ImGui_ImplVulkan_Init(&info);
#else
  ImGui_ImplVulkan_Init(&info, swapchain.renderPass());
#endif
#if IMGUI_VERSION_NUM < 19000  // later versions upload the font by themselves
  device.submit("font of the panel", [](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
}

void setStyle(double scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // no files beside those that the user asks for
  ImFontConfig font;
  constexpr double kFontPixels = 13;
  font.SizePixels = static_cast<float>(std::round(kFontPixels * scale));
  io.Fonts->AddFontDefault(&font);
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 4;
  style.FrameRounding = 2;
  style.Colors[ImGuiCol_WindowBg].w = 0.88f;
  style.ScaleAllSizes(static_cast<float>(scale));
}

}  // namespace

Overlay::Overlay(const GlfwWindow& window, VkInstance instance, const DisplayDevice& device, const Swapchain& swapchain,
                 double scale)
    : device_(device), descriptors_(makePool(device.get())) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  setStyle(scale);
  ImGui_ImplGlfw_InitForVulkan(window.get(), true);
  initialize(instance, device, swapchain, descriptors_.get());
}

Overlay::~Overlay() {
  device_.waitIdle();
  ImGui_ImplVulkan_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Overlay::beginFrame() {
  const auto queueLock = device_.lock();  // later versions upload the font here
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Overlay::endFrame() { ImGui::Render(); }

void Overlay::record(VkCommandBuffer commands) { ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands); }

}  // namespace malus::viewer
