// Published optical constants by name: bake/presets.yml, embedded.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/materials/optical_data.h"

namespace malus::bake {

struct Preset {
  std::string name;
  std::string source;  // publication
  OpticalData data;

  // Rounded to 4 decimals, more than the measurements of metals carry. Throws Error if the published data do not cover
  // a wavelength.
  OpticalConstants at(const glm::dvec3& nanometres) const;
  double at(OpticalData::Quantity quantity, double nanometres) const;
};

const std::vector<Preset>& presets();             // sorted by name
const Preset* findPreset(std::string_view name);  // nullptr if unknown

// Throws Error if the name is unknown, with the nearest one.
const Preset& requirePreset(const std::string& name);

}  // namespace malus::bake
