#include "bake/pack/material_fields.h"

#include <algorithm>

namespace malus::pack {

namespace {

// Compares a material with one that has the defaults.
struct FeatureFinder {
  std::uint32_t version = 0;  // of SRFX, that the fields found need; 0: none

  template <class T>
  void operator()(const Field& field, const T& value, const T& standard) {
    if ((field.isFeature || field.since > 1) && value != standard) version = std::max(version, field.since);
  }
};

std::uint32_t surfaceVersion(const Material& material) {
  const Material standard;
  FeatureFinder find{isPolarizingElement(material.kind) ? 1u : 0u};
  visitMaterial(find, material, standard);
  return find.version;
}

}  // namespace

bool Material::isPlain() const { return surfaceVersion(*this) == 0; }

std::uint32_t surfaceVersion(std::span<const Material> materials) {
  std::uint32_t version = 0;
  for (const Material& m : materials) version = std::max(version, surfaceVersion(m));
  return version;
}

std::uint32_t newestSurfaceVersion() {
  std::uint32_t version = 1;
  const Material any;
  visitMaterial([&](const Field& field, const auto&) { version = std::max(version, field.since); }, any);
  return version;
}

}  // namespace malus::pack
