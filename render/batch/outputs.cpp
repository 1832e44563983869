#include "render/batch/outputs.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"

namespace malus::render {

std::vector<std::string> frameOutputNames() {
  std::vector<std::string> names;
  names.reserve(kFrameOutputs.size());
  for (const FrameOutputInfo& info : kFrameOutputs) names.emplace_back(info.name);
  return names;
}

FrameOutputs::FrameOutputs(const std::vector<std::string>& names, std::string_view where) : bits_(0) {
  const std::vector<std::string> known = frameOutputNames();
  const std::string expected = fmt::format("{}", fmt::join(known, ", "));
  if (names.empty()) throw Error(where, "outputs: no output", expected);
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end())
      throw Error(where, fmt::format("outputs: unknown output '{}'{}", name, nearestClause(name, known)), expected);
    bits_ |= bit(kFrameOutputs[static_cast<std::size_t>(found - known.begin())].output);
  }
}

std::string FrameOutputs::stokesOutput() const {
  for (const FrameOutputInfo& info : kFrameOutputs)
    if (info.readsStokes && has(info.output)) return info.name;
  return {};
}

std::string FrameOutputs::sensorOutput() const {
  for (const FrameOutputInfo& info : kFrameOutputs)
    if (info.readsSensor && has(info.output)) return info.name;
  return {};
}

bool FrameOutputs::needImage() const { return (bits_ & ~(bit(FrameOutput::truth) | bit(FrameOutput::camera))) != 0; }

std::vector<std::string> FrameOutputs::names() const {
  std::vector<std::string> names;
  for (const FrameOutputInfo& info : kFrameOutputs)
    if (has(info.output)) names.emplace_back(info.name);
  return names;
}

}  // namespace malus::render
