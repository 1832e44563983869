// Results of several devices side by side: the paper's table with one column per device.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace malus::render {

// A results.json (RESULTS.md). Throws Error if the file is not one.
nlohmann::json readResults(const std::filesystem::path& path);

// Per scene a table for the terminal: a row per method, and per device and renderer the median time relative to
// `schlick`, with its time in milliseconds. Of several views the largest is taken. results: of readResults().
std::string devicesTable(const std::vector<nlohmann::json>& results);

}  // namespace malus::render
