#include "render/batch/processor.h"

#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace malus::render {

std::string processorFeatures() {
  static constexpr std::array kNames = {"sse4_2",  "avx",      "avx2",     "fma",        "f16c",     "bmi2",
                                        "avx512f", "avx512dq", "avx512bw", "avx512vl",   "avx512cd", "avx512_vbmi2",
                                        "vaes",    "gfni",     "asimd",    "vpclmulqdq", "sve"};
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("flags") && !line.starts_with("Features")) continue;
    std::istringstream words(line.substr(line.find(':') + 1));
    const std::set<std::string> all{std::istream_iterator<std::string>(words), {}};
    std::vector<std::string> found;
    for (const char* name : kNames)
      if (all.contains(name)) found.emplace_back(name);
    return fmt::format("{}", fmt::join(found, " "));
  }
  return {};
}

}  // namespace malus::render
