#include "render/compare/machine.h"

#include <array>
#include <ctime>
#include <fstream>
#include <thread>

namespace malus::render {

nlohmann::json machineJson() {
  nlohmann::json machine = {{"cpu", nullptr}, {"threads", std::thread::hardware_concurrency()}};
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t value = line.find_first_not_of(" \t", line.find(':') + 1);
    if (value != std::string::npos) machine["cpu"] = line.substr(value);
    break;
  }
  return machine;
}

std::string currentDate() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &utc)};
}

}  // namespace malus::render
