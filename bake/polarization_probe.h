// Measurement of what polarization changes in the image of a scene. The renderer that measures is handed in by the
// program (tools/malus.cpp), because baking does not depend on renderers.
#pragma once

#include <cstdint>
#include <functional>

#include "bake/pack/scene.h"

namespace malus::bake {

// A small image by the exact method against the same one by the exact method without polarization; no filter.
struct PolarizationProbe {
  std::uint32_t width = 0, height = 0;
  double relRms = 0;             // root of the summed squared differences over the summed squared exact values
  double shareOver1Percent = 0;  // of pixels with a colour that differs by more than 1 %
};
using MeasurePolarization = std::function<PolarizationProbe(const pack::Scene&)>;

}  // namespace malus::bake
