// A scene and the settings of its image, as the rules of the effects read them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bake/effects/effects.h"
#include "bake/effects/polarizing_paths.h"

namespace malus::bake {

inline bool isPositive(const glm::dvec3& v) { return v.x > 0 || v.y > 0 || v.z > 0; }
inline bool isDiffuseMaterial(const pack::Material& m) { return isPositive(m.albedo) || m.meshMaps.albedo.isUsed(); }

// Refers to the scene and the request; both must outlive it.
class EffectQuery {
 public:
  using Predicate = std::function<bool(const pack::Material&)>;
  EffectQuery(const pack::Scene& queriedScene, const ImageRequest& queriedRequest);

  const pack::Scene& scene;
  const ImageRequest& request;

  // Over the materials that a mesh uses.
  bool any(const Predicate& predicate) const;
  std::string names(const Predicate& predicate) const;  // "gold, glass"

  bool hasLinearFilter() const { return request.analyser[1] != 0 || request.analyser[2] != 0; }
  bool hasCircularFilter() const { return request.analyser[3] != 0; }
  bool reflects() const { return request.depth >= 1; }
  bool hasEnvironment() const { return scene.environment.size > 0 || isPositive(scene.environment.radiance); }
  bool isDiffuse() const;      // a surface has an albedo
  bool hasHighlights() const;  // a surface has a highlight of a light
  bool isLitByPointLights() const;
  bool isLitByAreaLights() const;  // an emitter that illuminates and a diffuse surface face each other
  bool isLitByEnvironment() const;
  bool isLit() const { return isLitByPointLights() || isLitByAreaLights() || isLitByEnvironment(); }
  // Light on its way to a surface passes polarizing elements or thin glass.
  bool filtersLight() const;
  // Polarized light enters a layer below an interface.
  bool lightsPolarized() const;
  // Computed by the first call, because it may compare every interface with every other one.
  const PolarizingPaths& paths() const;

 private:
  std::vector<const pack::Material*> used_;
  mutable std::optional<PolarizingPaths> paths_;
  mutable std::optional<bool> litByAreaLights_;
};

// Properties of a material that several rules read.
bool isPolarizedEmitter(const pack::Material& material);
bool isCoated(const pack::Material& material);
bool hasClearCoat(const pack::Material& material);
bool isAreaLight(const pack::Material& material);
// Light passes through it as one surface: a polarizer, a wave plate or thin glass.
bool isThinAndTransmits(const pack::Material& material);
// Whether light can meet the surface from its denser side, where total reflection occurs.
bool hasDenserSide(const pack::Scene& scene, const pack::Material& material);

}  // namespace malus::bake
