#include "render/viewer/window.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "meshprep/json_text.h"
#include "render/viewer/exit_limit.h"
#include "render/viewer/overlay.h"
#include "render/viewer/panel.h"
#include "render/viewer/report.h"
#include "render/viewer/save_image.h"
#include "render/viewer/window_input.h"

namespace malus::viewer {
using Clock = std::chrono::steady_clock;

namespace {

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void drawHelp(bool& isOpen) {
  if (!isOpen) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
  if (ImGui::Begin("Keys", &isOpen, ImGuiWindowFlags_AlwaysAutoResize)) {
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
      for (const KeyHelp& key : keyHelp()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(key.key);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(key.text);
      }
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

// Members are destroyed in reverse order: each may refer to those before it.
class ViewerWindow {
 public:
  ViewerWindow(const Request& request, const Host& host)
      : request_(request),
        host_(host),
        window_(request.width, request.height, fmt::format("malus: {}", request.pack->scene.name)),
        instance_(glfw_.extensions()),
        surface_(makeSurface(instance_.get(), window_)),
        device_(instance_, surface_.get(), request.device),
        pass_(device_),
        swapchain_(device_, surface_.get()),
        session_(request, host, device_, [] { glfwPostEmptyEvent(); }),
        input_(window_, session_, ui_) {
    ui_.scale = request.uiScale > 0 ? request.uiScale : window_.uiScale();
    ui_.device = device_.name();
  }

  void run() {
    std::uint32_t width = 0, height = 0;
    window_.size(width, height);
    resize(std::max(width, 1u), std::max(height, 1u));
    overlay_ = std::make_unique<Overlay>(window_, instance_.get(), device_, swapchain_, ui_.scale);
    // Compile the display pass before there is a window to close.
    device_.submit("first image", [&](VkCommandBuffer commands) { recordImage(commands, {}); });
    glfwShowWindow(window_.get());
    auto last = Clock::now();
    while (!glfwWindowShouldClose(window_.get())) {
      if (host_.interrupted()) throw Interrupted();
      waitForEvents();
      const auto start = Clock::now();
      const double passed = std::min(secondsSince(last), 0.1);
      last = start;
      animate(passed);
      window_.size(width, height);
      if (width == 0 || height == 0) {  // minimised
        glfwWaitEventsTimeout(kLongestWait);
        continue;
      }
      ui_.recorder.apply(session_.state);
      ui_.latency.submit(session_.update(width, height));
      const Published published = session_.renders().published();
      session_.updateBackground(published);
      probe(width, height);
      if (!needsFrame(published)) {
        returnFreedMemory();
        continue;
      }
      shownContent_ = contentKey(published);
      // A window of the panel takes its new size in the second frame.
      const std::uint64_t before = std::exchange(shownBackground_, backgroundKey());
      if (before != shownBackground_) input_.redraws = std::max<int>(input_.redraws, 2);
      resize(width, height);
      drawFrame(published);
      --input_.redraws;
      lastFrame_ = Clock::now();
      ui_.frames.add(1000 * secondsSince(start));
      writeFiles(published);
    }
    glfwHideWindow(window_.get());  // at once: threads may be in work
    swapchain_.finish();
    if (request_.json) print();
    if (instance_.messages() > 0)
      throw Error("", fmt::format("{} messages of the validation layers", instance_.messages()));
  }

 private:
  static constexpr double kLongestWait = 0.1;  // seconds

  // Changes with every publication of the threads.
  std::uint64_t contentKey(const Published& published) const {
    std::uint64_t sum = published.images << 32u;
    for (const PublishedSide& side : published.sides) sum += side.fine.rows + 7919 * side.problem.size();
    return sum + published.generation + backgroundKey();
  }

  // The part of contentKey() that changes the size of windows of the panel.
  std::uint64_t backgroundKey() const {
    const BackgroundState background = session_.background();
    std::uint64_t sum = background.reference.rows * 104729u;
    if (background.truth) sum += 15485863u * (background.pixel.x + 1u) + 32452843u * (background.pixel.y + 1u);
    for (const std::optional<SideError>& error : background.errors) sum += error ? 1299709u : 0u;
    return sum + (background.flip ? 611953u : 0u);
  }

  bool isActive() const { return input_.redraws > 0 || isAnimated(); }

  // Seconds to wait for the image of a changed view before a frame is drawn without it: such a frame would take time of
  // the image and show nothing new. 0: there is none, or it takes longer than a frame may.
  double secondsForImage(const Published& published) const {
    if (published.generation >= session_.generation()) return 0;
    return std::max(AdaptiveResolution::kLongestFrameMs / 1000 - secondsSince(lastFrame_), 0.0);
  }

  // Wakes for events, for new images, and to notice Ctrl-C.
  void waitForEvents() const {
    const double wait = isActive() ? secondsForImage(session_.renders().published()) : kLongestWait;
    if (wait > 0)
      glfwWaitEventsTimeout(wait);
    else
      glfwPollEvents();
  }

  // Now and then between frames: the program keeps freed memory for work that follows at once (tools/malus.cpp), and a
  // window stays open for hours.
  void returnFreedMemory() {
    constexpr double kInterval = 2;  // seconds
    if (secondsSince(returnedMemory_) < kInterval) return;
#ifdef __GLIBC__
    ::malloc_trim(0);
#endif
    returnedMemory_ = Clock::now();
  }

  bool needsFrame(const Published& published) const {
    return contentKey(published) != shownContent_ || (isActive() && secondsForImage(published) == 0);
  }

  void print() const {
    nlohmann::json report = reportSession(session_, device_.name());
    report["frameMs"] = reportMedian(ui_.frames);
    report["displayPassMs"] = reportMedian(ui_.displayPass);
    report["overlayMs"] = reportMedian(ui_.overlay);
    report["inputToPhoton"] = {{"rendered", reportLatency(ui_.latency.rendered())},
                               {"displayOnly", reportLatency(ui_.latency.displayOnly())}};
    console::printText(jsonText(report) + "\n");
  }

  void probe(std::uint32_t width, std::uint32_t height) {
    const double x = input_.mouseX(), y = input_.mouseY();
    ui_.isOverImage = x >= 0 && y >= 0 && x < width && y < height && !ImGui::GetIO().WantCaptureMouse;
    if (!ui_.isOverImage) return;
    ui_.mouseX = static_cast<std::uint32_t>(x);
    ui_.mouseY = static_cast<std::uint32_t>(y);
    if (ui_.showsProbe) session_.probe(ui_.mouseX, ui_.mouseY);
  }

  // Files that the last frame shows; a failure becomes the message of the panel.
  void writeFiles(const Published& published) {
    try {
      if (ui_.recorder.isRecording() && published.isComplete && published.generation == session_.generation()) {
        swapchain_.finish();
        savePng(ui_.recorder.file(), device_, *target_);
        ui_.message = fmt::format("saved {}", ui_.recorder.file());
        ui_.recorder.next(session_.state);
        input_.redraws = 3;
      }
      if (std::exchange(ui_.asksForSave, false)) {
        swapchain_.finish();
        const std::string file = ui_.saveFile.data();
        saveImage(file, session_, device_, *target_);
        ui_.message = fmt::format("saved {}", file);
        input_.redraws = 3;
      }
    } catch (const Error& error) {
      ui_.recorder.stop(session_.state);
      ui_.message = error.what();
      input_.redraws = 3;
    }
    if (!std::exchange(ui_.asksForCopy, false)) return;
    const std::string command = session_.command(ui_.editedSide, "view.png");
    glfwSetClipboardString(window_.get(), command.c_str());
    ui_.message = "copied: " + command;
    input_.redraws = 3;
  }

  bool isAnimated() const { return ui_.turnsPolarizer || ui_.flies || ui_.recorder.isRecording(); }

  void animate(double seconds) {
    constexpr double kDegreesPerSecond = 45;
    if (ui_.turnsPolarizer && session_.state.filter.kind == FilterKind::linear) {
      double& degrees = session_.state.filter.polarizerDegrees;
      degrees += kDegreesPerSecond * seconds;
      if (degrees >= 180) degrees -= 180;
    }
    input_.flyOn(seconds);
  }

  void resize(std::uint32_t width, std::uint32_t height) {
    swapchain_.resize(width, height);
    if (target_ && target_->width() == width && target_->height() == height) return;
    swapchain_.finish();
    target_ = std::make_unique<DisplayImageTarget>(device_, width, height);
  }

  void drawFrame(const Published& published) {
    overlay_->beginFrame();
    drawPanel(session_, ui_, published, session_.background());
    drawHelp(input_.showsHelp);
    overlay_->endFrame();
    // The panel may have changed the view.
    ui_.latency.submit(session_.update(session_.width(), session_.height()));
    const DisplayInput input = session_.input(published);
    const auto start = Clock::now();
    const bool isCurrent = swapchain_.draw(
        *target_, [&](VkCommandBuffer commands) { recordImage(commands, input); },
        [&](VkCommandBuffer commands) { overlay_->record(commands); });
    session_.addDisplayMs(1000 * secondsSince(start));
    if (const std::optional<double> ms = swapchain_.overlayMs()) ui_.overlay.add(*ms);
    ui_.latency.present(Clock::now(), published.generation);
    if (!isCurrent) input_.redraws = std::max<int>(input_.redraws, 1) + 1;
  }

  // After the frame before has finished.
  void recordImage(VkCommandBuffer commands, const DisplayInput& input) {
    if (const std::optional<double> ms = pass_.readMs()) ui_.displayPass.add(*ms);
    pass_.record(commands, input, *target_);
  }

  const Request& request_;
  const Host& host_;
  Glfw glfw_;
  GlfwWindow window_;
  DisplayInstance instance_;
  vulkan::OwnedChild<VkInstance, VkSurfaceKHR> surface_;
  DisplayDevice device_;
  DisplayPass pass_;
  Swapchain swapchain_;
  std::unique_ptr<DisplayImageTarget> target_;
  UiState ui_;
  Session session_;
  WindowInput input_;
  std::unique_ptr<Overlay> overlay_;
  std::uint64_t shownContent_ = ~std::uint64_t{0};  // contentKey() of the last frame
  std::uint64_t shownBackground_ = 0;               // backgroundKey() of the last frame
  Clock::time_point lastFrame_;
  Clock::time_point returnedMemory_;
};

}  // namespace

void runWindow(const Request& request, const Host& host) {
  auto window = std::make_unique<ViewerWindow>(request, host);
  std::optional<ExitLimit> limit;
  constexpr int kInterruptedCode = 130;  // as the program's
  try {
    window->run();
    limit.emplace(0);
  } catch (const Interrupted&) {
    limit.emplace(kInterruptedCode);
    window.reset();
    throw;
  }
  window.reset();
}

}  // namespace malus::viewer
