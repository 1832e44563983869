// Variants of the shaders: a method, and the effects that an image needs. A variant is a set of macros in a preamble,
// so that effects it leaves out are not compiled.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"
#include "shaders/effects.h"

namespace malus::vulkan {

// Form in which the rays of a variant are traced.
enum class Tracing : std::uint8_t {
  recursion,   // recursive methods: closest-hit shaders shade, trace further rays and return payloads
  hitRecords,  // the ray generation shader shades and traces every ray; the pipeline returns which triangle is hit
  rayQueries,  // the same by ray queries, without other shaders
};

// Shaders that trace recorded rays and do not shade (ray_replay.h).
enum class Replay : std::uint8_t {
  none,  // shaders that render
  nearest,
  shadow,
};

struct Variant {
  std::string method = "fresnel";
  std::uint32_t effects = shaders::kEveryEffect;  // bits of shaders::Effect
  bool fourAnalysers = false;                     // iterative: Stokes vectors, not only colours
  bool countRays = false;
  bool checkNumerics = false;
  Replay replay = Replay::none;  // else method and effects do not matter
  Tracing tracing = Tracing::recursion;
  // Without recursion: entries of the stack, which are waiting paths of an iterative method (pathStackSize()) and
  // waiting surfaces of a recursive one. At least 1; with recursion 0.
  std::uint32_t stackSize = 0;
  auto operator<=>(const Variant&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 is wrong here
};

// The variant for an image by a method, with the effects that the image needs. tracing: not recursion for an iterative
// method. Throws Error: an unknown method.
Variant variantFor(const pack::Scene& scene, std::string_view method, const render::RenderParameters& parameters,
                   Tracing tracing);
bool has(const Variant& variant, shaders::Effect effect);

// Extensions and macros of the variant, in GLSL.
std::string preamble(const Variant& variant);

enum class Stage { raygen, miss, closestHit, anyHit, compute };

// One shader of a pipeline.
struct StageSource {
  std::string path;  // of its file in the repository; of a closest hit of one kind of surface, with that kind
  Stage stage;
  // gpu::SurfaceKind of a closest hit that shades (shaders/stages/surface.rchit); empty: every kind.
  std::optional<std::uint32_t> kind = std::nullopt;
};
// With recursion: ray generation, the environment's miss shader, the shadow's where the variant has shadows, and a
// closest-hit shader for each gpu::SurfaceKind of the variant, in order. With hit records: ray generation, one miss and
// one closest-hit shader. Both end with the any-hit shader of all hits where the variant has cut-outs. With ray
// queries, and to replay rays by them: ray generation only.
std::vector<StageSource> stageSources(const Variant& variant);

// Text of a shader file by its path; empty: no such file. "shaders/methods/selected.h" is the variant's method.
std::string_view includedSource(const Variant& variant, std::string_view path);

// The source of a stage: #version, and an #include of each file in order, the stage's last.
std::string stageText(const StageSource& source);

}  // namespace malus::vulkan
