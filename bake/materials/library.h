// Published optical constants by name: bake/materials.json, embedded.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::bake {

struct OpticalConstants {
  std::string name;
  glm::dvec3 eta;      // at 630, 532 and 465 nm
  glm::dvec3 k;        // the index is eta - i k
  std::string source;  // publication
};

const std::vector<OpticalConstants>& materialLibrary();       // sorted by name
const OpticalConstants* findMaterial(std::string_view name);  // nullptr if unknown
std::vector<std::string> materialNames();

}  // namespace malus::bake
