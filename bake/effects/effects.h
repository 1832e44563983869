// The effect set of a scene: which kinds of light transport its materials, lights, camera and geometry call for.
// Conservative: an effect that is off cannot show in any picture that is asked for. Each has its reason.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"

namespace malus::bake {

// What is asked of a picture beside the scene. The baker does not know: it asks for the intensity without a filter at
// the scene's depth; a renderer refines the set by the same rules.
struct ImageRequest {
  std::uint32_t depth = 0;
  std::array<double, 4> analyser = {1, 0, 0, 0};  // first row of the filter's Mueller matrix
  bool linearStokes = false;                      // S1, S2, DoLP or AoLP are asked for
  bool circularStokes = false;                    // S3 is asked for
};

// In the order in which they are listed everywhere.
std::vector<pack::Effect> findEffects(const pack::Scene& scene, const ImageRequest& request);
std::vector<pack::Effect> findEffects(const pack::Scene& scene);  // for the baker

bool isOn(const std::vector<pack::Effect>& effects, std::string_view name);
std::vector<std::string> effectNames();

// The scene without some of its effects, by name: what the effect needs is taken away (lights, highlights, albedo,
// radiance, surroundings; glass becomes a glass mirror, a metal or a painted surface what lies under it, a polarizer or
// wave plate a grey sheet, a polarized sky the picture or the constant under it).
// linear-polarization, circular-polarization, filter and shadows are the renderer's to leave out. Throws Error for a
// name that is none, or one that is no effect of its own (tir, which belongs to dielectric).
pack::Scene withoutEffects(pack::Scene scene, const std::vector<std::string>& off);

}  // namespace malus::bake
