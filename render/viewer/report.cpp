#include "render/viewer/report.h"

namespace malus::viewer {

namespace {

nlohmann::json reportSide(const PublishedSide& side, const std::optional<SideError>& error) {
  return {{"method", side.method},
          {"device", side.device},
          {"image", side.isShared ? "shared" : "copied"},
          {"copiedBytes", side.copiedBytes},
          {"fullFrameMs", side.medianMs},
          {"relRms", error ? nlohmann::json(error->relRms) : nullptr},
          {"flip", error ? nlohmann::json(error->flip) : nullptr}};
}

}  // namespace

nlohmann::json reportSession(const Session& session, const std::string& display) {
  const Published published = session.renders().published();
  const BackgroundState background = session.background();
  nlohmann::json sides = nlohmann::json::array();
  for (std::size_t i = 0; i < (session.state.isSplit ? 2u : 1u); ++i)
    sides.push_back(reportSide(published.sides[i], background.errors[i]));
  return {{"scene", session.pack().scene.name},
          {"width", session.width()},
          {"height", session.height()},
          {"display", display},
          {"sides", sides}};
}

nlohmann::json reportMedian(const FrameTimes& times) {
  return times.count() > 0 ? nlohmann::json(times.median()) : nullptr;
}

nlohmann::json reportLatency(const std::vector<LatencySample>& samples) {
  if (samples.empty()) return nullptr;
  std::vector<double> ms, frames;
  for (const LatencySample& sample : samples) {
    ms.push_back(sample.ms);
    frames.push_back(sample.frames);
  }
  return {{"events", samples.size()},
          {"medianMs", quantile(ms, 0.5)},
          {"p95Ms", quantile(ms, 0.95)},
          {"medianFrames", quantile(frames, 0.5)},
          {"p95Frames", quantile(frames, 0.95)}};
}

}  // namespace malus::viewer
