// The effects that an image of a scene needs: kinds of light transport that its materials, lights, camera and geometry
// call for. Conservative: an effect that is off cannot change the image. shaders/effects.def lists the effects,
// bake/effects/rules.h contains the rule of each.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "shaders/effects.h"

namespace malus::bake {

// Settings of an image that its effects depend on. The baker assumes the intensity without a filter at the depth of the
// scene; a renderer knows the actual settings and applies the same rules again.
struct ImageRequest {
  std::uint32_t depth = 0;
  std::array<double, 4> analyser = {1, 0, 0, 0};  // first row of the filter's Mueller matrix
  bool linearStokes = false;                      // S1, S2, DoLP or AoLP are requested
  bool circularStokes = false;                    // S3 is requested
};

// The listed effects in the order of shaders/effects.def, each with its reason.
std::vector<pack::Effect> findEffects(const pack::Scene& scene, const ImageRequest& request);
std::vector<pack::Effect> findEffects(const pack::Scene& scene);  // for the baker

// Bits (shaders::effectBit) of the effects that the shaders need for the image.
std::uint32_t findCompiledEffects(const pack::Scene& scene, const ImageRequest& request);

bool isOn(const std::vector<pack::Effect>& effects, shaders::Effect effect);
bool isOn(const std::vector<pack::Effect>& effects, std::string_view name);  // name or alias
std::vector<std::string> effectNames();                                      // listed effects only

// The listed effect with a name or an alias. Throws Error for any other name.
shaders::Effect effectNamed(std::string_view name);

// The effect of the kind of surface that shades a kind of material.
shaders::Effect surfaceEffect(pack::MaterialKind kind);

// The scene without some of its effects, by name or alias: lights, highlights, albedo, radiance or the environment are
// removed; clear glass becomes a glass mirror, a metal or dielectric the diffuse surface below its interface, a
// polarizing element a grey filter, a Rayleigh sky the image or constant below it. The effects without a rule for
// removal (linear and circular polarization, filter, shadows) are left to the renderer. Throws Error for an unknown
// name and for tir, which follows from dielectric interfaces.
pack::Scene withoutEffects(pack::Scene scene, const std::vector<std::string>& off);

// Whether one of the effects, by name or alias, has a rule for removal, so that withoutEffects() can change a scene.
// Throws Error for an unknown name.
bool canBeRemoved(const std::vector<std::string>& off);

}  // namespace malus::bake
