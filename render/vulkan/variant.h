// A variant of the shaders: the method, and which effects the scene calls for. Named by a set of macros
// that glslang gets as a preamble; what a macro leaves out costs nothing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <shaders/effects.h>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"

namespace malus::vulkan {

struct Variant {
  std::string method = "fresnel";
  std::uint32_t effects = shaders::kEveryEffect;  // bits of shaders::Effect
  bool fourAnalysers = false;                     // of a loop: Stokes vectors
  bool countRays = false;
  bool checkNumerics = false;
  std::uint32_t stackSize = 0;  // of a loop: ways that may wait; 0 for a recursive method
  auto operator<=>(const Variant&) const = default;
};

// What the picture calls for.
Variant variantFor(const pack::Scene& scene, std::string_view method, const render::RenderParameters& parameters);
bool has(const Variant& variant, shaders::Effect effect);

// #version, extensions and macros of the variant.
std::string preamble(const Variant& variant);

enum class Stage { raygen, miss, closestHit, compute };

// One shader of the pipeline: its file, and the stage.
struct StageSource {
  std::string_view path;
  Stage stage;
  std::uint32_t kind = 0;  // of a closest hit: gpu::SurfaceKind
};
// Ray generation, environment miss, shadow miss where there are shadows, then a closest hit for every gpu::SurfaceKind
// that the variant has, in order; of a loop ray generation alone.
std::vector<StageSource> stageSources(const Variant& variant);

// Text of a file by its path, "shaders/methods/selected.h" being the variant's method.
std::string_view includedSource(const Variant& variant, std::string_view path);

// The whole text of a stage: language, optics, method, then the stage's file, as #include lines.
std::string stageText(const StageSource& source);

}  // namespace malus::vulkan
