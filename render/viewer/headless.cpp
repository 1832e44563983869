#include "render/viewer/headless.h"

#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "meshprep/json_text.h"
#include "render/viewer/frame_times.h"
#include "render/viewer/report.h"
#include "render/viewer/save_image.h"
#include "render/viewer/script.h"
#include "render/viewer/session.h"

namespace malus::viewer {
using Clock = std::chrono::steady_clock;

namespace {

constexpr int kLongestWaitMs = 600000;

double elapsedMs(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Frame {
  double ms = 0;
  std::optional<double> displayMs;  // of the display pass, by the clock of the device
  bool rendered = false;            // a new image, else the display pass alone
  double fraction = 1;              // share of the resolution
};

class HeadlessRun {
 public:
  HeadlessRun(const Request& request, const Host& host)
      : request_(request),
        host_(host),
        instance_({}),
        device_(instance_, VK_NULL_HANDLE, request.device),
        pass_(device_),
        target_(device_, request.width, request.height),
        session_(request, host, device_, [] {}) {
    if (request.script.empty()) return;
    lines_ = readScript(request.script);
    checkScript(lines_, session_.state, session_.effects());
    for (const ScriptLine& line : lines_)
      if (line.first >= request.frames)
        console::warn(fmt::format("{}: is behind the last frame, {} (--frames)", line.where, request.frames - 1));
  }

  void run() {
    show();  // compiles and allocates; not measured
    wait(false);
    for (std::uint32_t frame = 0; frame < request_.frames; ++frame) {
      if (host_.interrupted()) throw Interrupted();
      runFrame(frame);
    }
    if (instance_.messages() > 0)
      throw Error("", fmt::format("{} messages of the validation layers", instance_.messages()));
    print();
  }

 private:
  // One frame: the changes of its lines, the images that they need at the adaptive resolution, and the display pass.
  // Lines that wait or save are not part of its time.
  void runFrame(std::uint32_t number) {
    const auto start = Clock::now();
    std::vector<const ScriptLine*> actions;
    for (const ScriptLine& line : lines_) {
      if (number < line.first || number > line.last) continue;
      if (applyLine(line, session_.state, session_.effects()) != ScriptAction::none) actions.push_back(&line);
    }
    const std::uint64_t before = session_.generation();
    const bool rendered = session_.update(request_.width, request_.height) != before;
    if (rendered) wait(false);
    show();
    frames_.push_back({elapsedMs(start), pass_.readMs(), rendered, session_.renders().published().fraction});
    for (const ScriptLine* line : actions) act(*line);
  }

  void act(const ScriptLine& line) {
    const std::string& command = line.words.front();
    wait(true);
    if (command == "wait-reference") waitForReference();
    if (command == "command") console::printText(session_.command(0, line.words[1]) + "\n");
    show();
    if (command == "save") saveImage(line.words[1], session_, device_, target_);
  }

  // Until the reference is complete and the errors of the sides are known.
  void waitForReference() {
    session_.state.usesReference = true;
    for (;;) {
      if (host_.interrupted()) throw Interrupted();
      session_.update(request_.width, request_.height);
      session_.updateBackground(session_.renders().published());
      const BackgroundState state = session_.background();
      if (!state.problem.empty()) throw Error("", state.problem);
      if (state.errors[0] && (session_.state.shown != Quantity::flip || state.flip)) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  void wait(bool complete) {
    const std::uint64_t generation = session_.update(request_.width, request_.height);
    if (!session_.renders().waitFor(generation, complete, kLongestWaitMs)) {
      if (host_.interrupted()) throw Interrupted();
      session_.update(request_.width, request_.height);  // throws the error of the thread
      throw Error("", "no image within ten minutes", "a smaller --width, --depth or --samples");
    }
    for (const PublishedSide& side : session_.renders().published().sides)
      if (!side.problem.empty()) throw Error("", side.problem);
  }

  void show() {
    session_.update(request_.width, request_.height);
    const DisplayInput input = session_.input(session_.renders().published());
    const auto start = Clock::now();
    device_.submit("display", [&](VkCommandBuffer commands) { pass_.record(commands, input, target_); });
    session_.addDisplayMs(elapsedMs(start));
    if (const std::optional<double> ms = pass_.readMs()) passTimes_.add(*ms);
  }

  std::vector<double> times(bool rendered) const {
    std::vector<double> result;
    for (const Frame& frame : frames_)
      if (frame.rendered == rendered) result.push_back(frame.ms);
    return result;
  }

  nlohmann::json summary(bool rendered) const {
    const std::vector<double> ms = times(rendered);
    if (ms.empty()) return nullptr;
    double sum = 0, fractions = 0;
    for (const double v : ms) sum += v;
    for (const Frame& frame : frames_) fractions += frame.rendered == rendered ? frame.fraction : 0;
    const auto count = static_cast<double>(ms.size());
    return {{"frames", ms.size()},          {"medianMs", quantile(ms, 0.5)},         {"p95Ms", quantile(ms, 0.95)},
            {"longestMs", quantile(ms, 1)}, {"framesPerSecond", 1000 * count / sum}, {"resolution", fractions / count}};
  }

  void print() const {
    if (request_.json) {
      nlohmann::json all = nlohmann::json::array();
      for (const Frame& frame : frames_)
        all.push_back({{"ms", frame.ms},
                       {"displayPassMs", frame.displayMs ? nlohmann::json(*frame.displayMs) : nullptr},
                       {"rendered", frame.rendered},
                       {"resolution", frame.fraction}});
      nlohmann::json report = reportSession(session_, device_.name());
      report["displayPassMs"] = reportMedian(passTimes_);
      report["rendered"] = summary(true);
      report["displayOnly"] = summary(false);
      report["frames"] = all;
      console::printText(jsonText(report) + "\n");
      return;
    }
    for (const bool rendered : {true, false})
      if (const nlohmann::json s = summary(rendered); !s.is_null())
        console::printLine(
            "{}: {} frames {}, median {:.1f} ms, 95 % within {:.1f} ms, {:.0f} per second{}",
            session_.pack().scene.name, s["frames"].get<std::size_t>(), rendered ? "rendered" : "displayed only",
            s["medianMs"].get<double>(), s["p95Ms"].get<double>(), s["framesPerSecond"].get<double>(),
            rendered ? fmt::format(", at {:.0f} % of the resolution", 100 * s["resolution"].get<double>())
                     : std::string());
  }

  const Request& request_;
  const Host& host_;
  DisplayInstance instance_;
  DisplayDevice device_;
  DisplayPass pass_;
  DisplayImageTarget target_;
  Session session_;
  std::vector<ScriptLine> lines_;
  std::vector<Frame> frames_;
  FrameTimes passTimes_;
};

}  // namespace

void runHeadless(const Request& request, const Host& host) { HeadlessRun(request, host).run(); }

}  // namespace malus::viewer
