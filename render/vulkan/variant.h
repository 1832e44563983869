// Variants of the shaders: a method, and the effects that an image needs. A variant is a set of macros in a preamble,
// so that effects it leaves out are not compiled.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"
#include "shaders/effects.h"

namespace malus::vulkan {

struct Variant {
  std::string method = "fresnel";
  std::uint32_t effects = shaders::kEveryEffect;  // bits of shaders::Effect
  bool fourAnalysers = false;                     // iterative: Stokes vectors, not only colours
  bool countRays = false;
  bool checkNumerics = false;
  std::uint32_t stackSize = 0;  // iterative: paths that can wait on the stack; recursive: 0
  auto operator<=>(const Variant&) const = default;
};

// The variant for an image by a method, with the effects that the image needs. Throws Error: an unknown method.
Variant variantFor(const pack::Scene& scene, std::string_view method, const render::RenderParameters& parameters);
bool has(const Variant& variant, shaders::Effect effect);
bool isIterative(const Variant& variant);

// Extensions and macros of the variant, in GLSL.
std::string preamble(const Variant& variant);

enum class Stage { raygen, miss, closestHit, compute };

// One shader of a pipeline. A closest hit is shaders/stages/surface.rchit for one kind of surface.
struct StageSource {
  std::string path;  // of its file in the repository; of a closest hit, of the kind of surface
  Stage stage;
  std::uint32_t kind = 0;  // of a closest hit: gpu::SurfaceKind
};
// Recursive: ray generation, the environment's miss shader, the shadow's where the variant has shadows, and a
// closest-hit shader for each gpu::SurfaceKind of the variant, in order. Iterative: ray generation only.
std::vector<StageSource> stageSources(const Variant& variant);

// Text of a shader file by its path; empty: no such file. "shaders/methods/selected.h" is the variant's method.
std::string_view includedSource(const Variant& variant, std::string_view path);

// The source of a stage: #version, and an #include of each file in order, the stage's last.
std::string stageText(const StageSource& source);

}  // namespace malus::vulkan
