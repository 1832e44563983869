#include "render/vulkan/variant.h"

#include <algorithm>

#include <fmt/format.h>

#include "render/scene/compiled_effects.h"
#include "render/scene/methods.h"
#include "shaders/gpu/scene.h"
#include "shaders/sources.h"

namespace malus::vulkan {

using shaders::Effect;

namespace {

// Effects that the paper's scenes do not have, and that do not read MaterialExtra.
constexpr Effect kWithoutExtras[] = {Effect::kSky, Effect::kLightShapes, Effect::kOrthographic, Effect::kAreaLights,
                                     Effect::kEnvironmentLight};

// Whether the shaders read MaterialExtra.
bool readsMaterialExtras(const Variant& variant) {
  for (std::size_t i = 0; i < shaders::kCompiledEffects.size(); ++i)
    if ((variant.effects >> i & 1) != 0 && shaders::kCompiledEffects[i].build == "every" &&
        std::ranges::find(kWithoutExtras, static_cast<Effect>(i)) == std::end(kWithoutExtras))
      return true;
  return false;
}

bool isIterative(const Variant& variant) { return render::methodNamed(variant.method).isIterative; }

const char* raygenPath(const Variant& variant) {
  if (variant.replay != Replay::none) return "shaders/stages/replay.rgen";
  return isIterative(variant) ? "shaders/stages/camera_path.rgen" : "shaders/stages/raygen.rgen";
}

// Of every closest hit; the last, so that the indices of the others are those of their groups.
void addAnyHit(const Variant& variant, std::vector<StageSource>& sources) {
  if (variant.replay == Replay::none && has(variant, Effect::kCutOuts) && has(variant, Effect::kMeshTextures))
    sources.push_back({"shaders/stages/cut_out.rahit", Stage::anyHit});
}

}  // namespace

bool has(const Variant& variant, Effect effect) { return (variant.effects & shaders::effectBit(effect)) != 0; }

Variant variantFor(const pack::Scene& scene, std::string_view method, const render::RenderParameters& parameters,
                   Tracing tracing) {
  Variant variant;
  variant.method = method;
  variant.effects = render::compiledEffects(scene, parameters);
  variant.tracing = tracing;
  const render::MethodInfo& info = render::methodNamed(method);
  if (info.isIterative) {
    variant.fourAnalysers = render::hasStokes(info, parameters);
    variant.stackSize = render::pathStackSize(variant.effects, parameters.depth);
  } else if (tracing != Tracing::recursion) {
    variant.stackSize = std::max(parameters.depth, 1u);
  }
  return variant;
}

std::string preamble(const Variant& variant) {
  std::string text =
      "#extension GL_EXT_ray_tracing : require\n"
      "#extension GL_EXT_scalar_block_layout : require\n"
      "#extension GL_GOOGLE_include_directive : require\n";
  if (variant.tracing == Tracing::rayQueries)
    text += "#extension GL_EXT_ray_query : require\n#define MALUS_RAY_QUERIES\n";
  if (variant.tracing != Tracing::recursion) text += fmt::format("#define MALUS_STACK_SIZE {}\n", variant.stackSize);
  text += fmt::format("#define MALUS_METHOD \"{}\"\n", variant.method);
  for (std::size_t i = 0; i < shaders::kCompiledEffects.size(); ++i) {
    const shaders::CompiledEffect& effect = shaders::kCompiledEffects[i];
    // Shaders that recurse have no rays that return a hit.
    const bool isLeftOut = variant.tracing == Tracing::recursion && static_cast<Effect>(i) == Effect::kFilteredShadows;
    text += fmt::format("#define {} {}\n", effect.macro, isLeftOut ? 0u : variant.effects >> i & 1);
    if (effect.isSurface) text += fmt::format("#define k{} {}u\n", effect.identifier, i);
  }
  text += fmt::format("#define MALUS_MATERIAL_EXTRAS {}\n", readsMaterialExtras(variant) ? 1 : 0);
  if (variant.fourAnalysers) text += "#define MALUS_FOUR_ANALYSERS\n";
  if (variant.countRays) text += "#define MALUS_COUNT_RAYS\n";
  if (variant.checkNumerics) text += "#define MALUS_CHECK_NUMERICS\n";
  if (variant.replay == Replay::shadow) text += "#define MALUS_REPLAY_SHADOWS\n";
  return text;
}

std::vector<StageSource> stageSources(const Variant& variant) {
  std::vector<StageSource> sources = {{raygenPath(variant), Stage::raygen}};
  if (variant.tracing == Tracing::rayQueries) return sources;
  if (variant.tracing == Tracing::hitRecords) {
    sources.push_back({"shaders/stages/hit_record.rmiss", Stage::miss});
    sources.push_back({"shaders/stages/hit_record.rchit", Stage::closestHit});
    addAnyHit(variant, sources);
    return sources;
  }
  sources.push_back({"shaders/stages/environment.rmiss", Stage::miss});
  const bool hasLights = has(variant, Effect::kPointLights) || has(variant, Effect::kAreaLights) ||
                         has(variant, Effect::kEnvironmentLight);
  if (hasLights && has(variant, Effect::kShadows)) sources.push_back({"shaders/stages/shadow.rmiss", Stage::miss});
  for (std::uint32_t kind = 0; kind < gpu::kSurfaceKinds; ++kind)
    if ((variant.effects >> kind & 1) != 0)
      sources.push_back({fmt::format("shaders/stages/surface.rchit, {}", shaders::kCompiledEffects[kind].identifier),
                         Stage::closestHit, kind});
  addAnyHit(variant, sources);
  return sources;
}

std::string_view includedSource(const Variant& variant, std::string_view path) {
  if (path != "shaders/methods/selected.h") return shaders::source(path);
  std::string file = variant.method;
  std::replace(file.begin(), file.end(), '-', '_');
  return shaders::source(fmt::format("shaders/{}/{}.h", isIterative(variant) ? "iterative" : "methods", file));
}

std::string stageText(const StageSource& source) {
  std::string text = "#version 460\n";
  for (const char* file :
       {"shaders/gpu/language.glsl", "shaders/optics/math.h", "shaders/optics/all.h", "shaders/gpu/constants.h",
        "shaders/gpu/scene.h", "shaders/gpu/fault.h", "shaders/methods/selected.h"})
    text += fmt::format("#include \"{}\"\n", file);
  if (!source.kind) return text + fmt::format("#include \"{}\"\n", source.path);
  return text + fmt::format("#define MALUS_SHADE shade{}\n#include \"shaders/stages/surface.rchit\"\n",
                            shaders::kCompiledEffects[*source.kind].identifier);
}

}  // namespace malus::vulkan
