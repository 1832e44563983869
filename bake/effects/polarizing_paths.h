// Diattenuating and phase-shifting elements that one path of light can contain. They decide whether polarization
// changes the image (shaders/optics/CONVENTIONS.md, "When polarization may be left out").
#pragma once

#include <cstdint>
#include <string>

namespace malus::bake {

class EffectQuery;

// Materials are comma-separated names.
struct PolarizingPaths {
  std::string interfaces;         // materials that reflect or refract
  std::string polarizedEmitters;  // emitters of linearly polarized light
  std::string phaseShifters;      // kinds of element that convert between linear and circular polarization
  bool polarizedSky = false;
  bool diffuseExit = false;         // diffuse light leaves from below an interface
  bool polarizedEntry = false;      // polarized light enters a diffuse layer below an interface
  bool mutuallyVisible = false;     // light can travel from one interface to another
  std::uint32_t interactions = 0;   // most interfaces on a path
  std::uint32_t diattenuators = 0;  // most diattenuating elements on a path, without the filter
  bool hasPolarizedSources() const { return polarizedSky || !polarizedEmitters.empty(); }
  bool canPolarize() const { return interactions > 0 || diffuseExit || hasPolarizedSources(); }
};
PolarizingPaths findPolarizingPaths(const EffectQuery& query);

}  // namespace malus::bake
