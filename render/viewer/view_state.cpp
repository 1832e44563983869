#include "render/viewer/view_state.h"

#include <algorithm>

#include <fmt/format.h>

#include "render/scene/methods.h"

namespace malus::viewer {

std::optional<Quantity> quantityNamed(std::string_view name) {
  const auto found = std::ranges::find(kQuantityNames, name);
  if (found == kQuantityNames.end()) return std::nullopt;
  return static_cast<Quantity>(found - kQuantityNames.begin());
}

render::Analyser FilterState::analyser() const {
  render::Analyser analyser = render::kNoFilter;
  if (kind == FilterKind::linear) analyser = render::linearPolarizer(polarizerDegrees);
  if (kind == FilterKind::right) analyser = render::circularAnalyser(render::Handedness::right);
  if (kind == FilterKind::left) analyser = render::circularAnalyser(render::Handedness::left);
  return hasPlate ? render::behindWavePlate(analyser, plate) : analyser;
}

render::JobSettings jobSettings(const ViewState& state, const SideSettings& side, std::uint32_t width,
                                std::uint32_t height, const std::vector<pack::Effect>& needed) {
  render::JobSettings job;
  job.backend = side.backend;
  job.method = side.method;
  job.width = width;
  job.height = height;
  job.samples = state.samples;
  job.lightSamples = state.lightSamples;
  job.depth = state.depth;
  job.effects = effectsOption(side.effects, needed);
  const bool hasMethods = render::backendInfo(side.backend).hasMethods;
  if (hasMethods) {
    const render::MethodInfo& method = render::methodNamed(side.method);
    job.stokes = method.isIterative && method.hasStokes && side.iterativeStokes;
    job.storesStokes = method.hasStokes && (!method.isIterative || job.stokes);
  } else {
    job.storesStokes = true;
  }
  // The display pass applies the filter to stored Stokes vectors; without them the renderer has to.
  if (!job.storesStokes) job.analyser = state.filter.analyser();
  return job;
}

std::string effectsOption(const EffectSwitches& switches, const std::vector<pack::Effect>& needed) {
  const auto count = [&](EffectSwitch value) {
    return std::ranges::count_if(switches, [&](const auto& entry) { return entry.second == value; });
  };
  if (count(EffectSwitch::automatic) == static_cast<std::ptrdiff_t>(switches.size())) return "auto";
  if (static_cast<std::size_t>(count(EffectSwitch::on)) == needed.size()) return "all";
  std::string names;
  for (const pack::Effect& effect : needed) {
    const auto found = switches.find(effect.name);
    const EffectSwitch value = found == switches.end() ? EffectSwitch::automatic : found->second;
    if (value == EffectSwitch::on || (value == EffectSwitch::automatic && effect.on))
      names += (names.empty() ? "" : ",") + effect.name;
  }
  return names.empty() ? "tir" : names;  // which follows from glass, and changes nothing without it
}

EffectSwitches effectSwitches(const std::string& option, const std::vector<pack::Effect>& needed) {
  EffectSwitches switches;
  if (option == "auto") return switches;
  const std::string list = "," + option + ",";
  for (const pack::Effect& effect : needed) {
    const bool isKept = option == "all" || list.find("," + effect.name + ",") != std::string::npos;
    switches[effect.name] = isKept ? EffectSwitch::on : EffectSwitch::off;
  }
  return switches;
}

}  // namespace malus::viewer
