// Measured times as JSON, of the window and of the run without one (VIEW.md).
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "render/viewer/frame_times.h"
#include "render/viewer/input_latency.h"
#include "render/viewer/session.h"

namespace malus::viewer {

// Scene, size, device and sides: the part that both runs have.
nlohmann::json reportSession(const Session& session, const std::string& display);

// Median of the last 30 frames; null without frames, for example without a clock of the device.
nlohmann::json reportMedian(const FrameTimes& times);

// Null without samples.
nlohmann::json reportLatency(const std::vector<LatencySample>& samples);

}  // namespace malus::viewer
