// The machine that a comparison ran on, and the time.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace malus::render {

// {"cpu": model name of the first processor, or null; "threads": hardware threads}. Source: /proc/cpuinfo.
nlohmann::json machineJson();

// The current time in UTC: "2026-01-31 12:30 UTC".
std::string currentDate();

}  // namespace malus::render
