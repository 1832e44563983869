#include "bake/materials/library.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace malus::bake {

extern const std::string_view kMaterialsJson;  // generated from bake/materials.json by the build

const std::vector<OpticalConstants>& materialLibrary() {
  static const std::vector<OpticalConstants> kLibrary = [] {
    const nlohmann::json document = nlohmann::json::parse(kMaterialsJson);
    std::vector<OpticalConstants> list;
    for (const auto& item : document.at("materials").items()) {
      const auto triple = [&](const char* key) {
        const nlohmann::json& v = item.value().at(key);
        return glm::dvec3(v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>());
      };
      list.push_back({item.key(), triple("eta"), triple("k"), item.value().at("source").get<std::string>()});
    }
    return list;
  }();
  return kLibrary;
}

const OpticalConstants* findMaterial(std::string_view name) {
  const auto& list = materialLibrary();
  const auto at = std::find_if(list.begin(), list.end(), [&](const OpticalConstants& m) { return m.name == name; });
  return at == list.end() ? nullptr : &*at;
}

std::vector<std::string> materialNames() {
  std::vector<std::string> names;
  for (const OpticalConstants& m : materialLibrary()) names.push_back(m.name);
  return names;
}

}  // namespace malus::bake
