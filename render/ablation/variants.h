// The images of an ablation: the complete one, and one without each effect, bounce or sample.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

enum class VariantKind {
  complete,      // every effect that the image needs, by the complete recursive method
  effect,        // without one effect
  polarization,  // without circular, or any, polarization between surfaces
  depth,         // without the bounces from a number on
  samples,       // with fewer samples of area lights and of the environment
};
const char* variantKindName(VariantKind kind);

struct Variant {
  VariantKind kind = VariantKind::complete;
  std::string name;  // of the effect; "bounce 5"; "2 of 4 light samples"; of the complete image empty
  std::string method;
  RenderParameters parameters;
  std::shared_ptr<const pack::Scene> scene;  // without the effect; null: that of the pack
};

// The variants of an image, the complete one first; then, in the order in which they are worth measuring: polarization,
// effects, bounces from the last to the first, and half as many light samples and so on down to one. Bounces: at most
// kMostBounces, the last ones and, before them, some of the others. Effects: those that the image needs and that can be
// left out alone.
inline constexpr std::size_t kMostBounces = 12;
std::vector<Variant> ablationVariants(const pack::Scene& scene, const RenderParameters& parameters);

}  // namespace malus::render
