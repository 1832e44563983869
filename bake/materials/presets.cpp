#include "bake/materials/presets.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "bake/materials/optical_file.h"
#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"

namespace malus::bake {

extern const std::string_view kPresetsYaml;  // generated from bake/presets.yml by the build

double Preset::at(OpticalData::Quantity quantity, double nanometres) const {
  return std::round(data.at(quantity, nanometres) * 1e4) / 1e4;
}

OpticalConstants Preset::at(const glm::dvec3& nanometres) const {
  OpticalConstants constants;
  for (int c = 0; c < 3; ++c) {
    constants.eta[c] = at(OpticalData::Quantity::n, nanometres[c]);
    constants.k[c] = at(OpticalData::Quantity::k, nanometres[c]);
  }
  return constants;
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> kPresets = [] {
    std::vector<Preset> list;
    for (const auto& item : YAML::Load(std::string(kPresetsYaml))) {
      const auto name = item.first.as<std::string>();
      list.push_back(
          {name, item.second["REFERENCES"].as<std::string>(), parseOpticalData(item.second, "preset " + name)});
    }
    std::sort(list.begin(), list.end(), [](const Preset& a, const Preset& b) { return a.name < b.name; });
    return list;
  }();
  return kPresets;
}

const Preset* findPreset(std::string_view name) {
  const auto& list = presets();
  const auto at = std::find_if(list.begin(), list.end(), [&](const Preset& p) { return p.name == name; });
  return at == list.end() ? nullptr : &*at;
}

const Preset& requirePreset(const std::string& name) {
  if (const Preset* found = findPreset(name)) return *found;
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.push_back(preset.name);
  const std::string near = nearestName(name, names);
  throw Error(fmt::format("'{}'", name), "unknown material",
              near.empty()
                  ? "a name from 'malus --list-materials', or a file .yml or .csv"
                  : fmt::format("'{}' or another from 'malus --list-materials', or a file .yml or .csv", near));
}

}  // namespace malus::bake
