// Light of the reference that starts at a source: the environment, emitters, and point, spot and directional lights at
// a surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/reference/hit.h"
#include "render/reference/queries.h"

namespace malus::reference {

// Light from the environment along -d: S1 is perpendicular to the plane of d and the sun.
Light environmentLight(const pack::Environment& environment, const dvec3& d);

// Light of the emitter at a hit along -d, as basic radiance.
Light emittedLight(const Hit& hit);

// A light in front of a hit, which arrives unless a surface is in the way.
struct Arrival {
  double cosine;        // with the shading normal
  double lobe;          // of the highlight
  dvec3 irradiance;     // at normal incidence, without absorption on the way
  double absorbedOver;  // length of the way through the medium; 0 of a light at infinity, as of the environment
};

// Appends the lights that a hit reflects, and the ways to them. hasHighlight: highlights are seen at the mirror
// direction.
void findArrivals(const SceneAccess& access, const Hit& hit, bool hasHighlight, const dvec3& mirror,
                  std::vector<Arrival>& arrivals, std::vector<ShadowRay>& ways);

// Diffuse radiance below the interface, and highlight radiance along the mirror direction.
struct DirectLight {
  dvec3 diffuse, highlight;
};
// visible: not 0 for each light that arrives.
DirectLight directLight(const SceneAccess& access, const Hit& hit, std::span<const Arrival> arrivals,
                        std::span<const std::uint8_t> visible);

}  // namespace malus::reference
