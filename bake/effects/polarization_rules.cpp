#include <fmt/format.h>

#include "bake/effects/rules.h"

namespace malus::bake {
using shaders::Effect;

namespace {

// Linear polarization is needed if it is requested, or if one path has two diattenuators, the filter included.
bool needsLinear(const EffectQuery& q) {
  const PolarizingPaths& p = q.paths();
  return p.diattenuators >= 2 || p.polarizedEntry ||
         ((q.request.linearStokes || q.hasLinearFilter()) && p.canPolarize());
}

std::string linearReason(const EffectQuery& q, bool on) {
  const PolarizingPaths& p = q.paths();
  if (!on) {
    if (p.interfaces.empty() || q.request.depth == 0 || p.mutuallyVisible)
      return "no path has two diattenuating surfaces";
    return fmt::format("no path has two diattenuating surfaces: {} are not visible from each other", p.interfaces);
  }
  if (q.request.linearStokes) return "S1 and S2 are requested";
  if (p.diattenuators < 2 && p.polarizedEntry) return "polarized light of lamps enters diffuse layers below interfaces";
  if (p.diattenuators >= 2 && p.hasPolarizedSources())
    return fmt::format("polarized light ({}{}{}) reaches {}; not needed at depth 0", p.polarizedSky ? "sky" : "",
                       p.polarizedSky && !p.polarizedEmitters.empty() ? ", " : "", p.polarizedEmitters, p.interfaces);
  if (p.diattenuators >= 2)
    return fmt::format("paths of depth {} can have two diattenuating surfaces: {}; not needed at depth <= {}",
                       q.request.depth, p.interfaces, p.diffuseExit ? 0 : 1);
  return fmt::format("a linear polarizer is in front of the camera, and {} polarize; not needed without the filter",
                     p.interfaces.empty() ? "light sources" : p.interfaces);
}

// A phase shifter (metal, total reflection, wave plate, thin film) behind a diattenuator makes circular light. It
// changes an intensity if two shifters are strictly between two diattenuators, the first of which may be the filter; if
// the filter passes one handedness, or S3 is requested, one shifter suffices.
bool circularIsRecorded(const EffectQuery& q) {
  return (q.request.circularStokes || q.hasCircularFilter()) && q.paths().diattenuators >= 2;
}
std::uint32_t chainLength(const EffectQuery& q) { return q.paths().diattenuators + (q.hasLinearFilter() ? 1u : 0u); }

bool needsCircular(const EffectQuery& q) {
  return !q.paths().phaseShifters.empty() && (circularIsRecorded(q) || chainLength(q) >= 4);
}

std::string circularReason(const EffectQuery& q, bool on) {
  const std::string& shifters = q.paths().phaseShifters;
  if (!on) return "no path has two phase shifters between two diattenuators";
  if (circularIsRecorded(q))
    return q.request.circularStokes ? fmt::format("S3 is requested, made by {}", shifters)
                                    : fmt::format("the filter passes one handedness; circular light by {}", shifters);
  return fmt::format(
      "paths of depth {} can have two phase shifters ({}) between two diattenuators; not needed at depth <= {}",
      q.request.depth, shifters, q.request.depth - (chainLength(q) - 3));
}

}  // namespace

std::vector<EffectRule> polarizationRules() {
  return {
      {Effect::kLinearPolarization, needsLinear, linearReason, {}},
      {Effect::kCircularPolarization, needsCircular, circularReason, {}},
      {Effect::kFilter,
       [](const EffectQuery& q) { return q.hasLinearFilter() || q.hasCircularFilter(); },
       [](const EffectQuery&, bool on) {
         return on ? "a filter is in front of the camera" : "no filter is in front of the camera";
       },
       {}},
  };
}

}  // namespace malus::bake
