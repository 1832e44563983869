#include "render/vulkan/variant.h"

#include <algorithm>

#include <fmt/format.h>

#include "render/scene/methods.h"
#include "shaders/sources.h"

namespace malus::vulkan {

Variant variantFor(const pack::Scene& scene, std::string_view method, std::uint32_t depth, bool everyEffect) {
  Variant variant;
  const auto isGlass = [&](const pack::Mesh& mesh) {
    return scene.materials[mesh.material].kind == pack::MaterialKind::glass;
  };
  // Without glass nothing waits; an array has one place at least.
  if (render::methodNamed(method).isLoop)
    variant.stackSize =
        everyEffect || std::any_of(scene.meshes.begin(), scene.meshes.end(), isGlass) ? std::max(depth, 1u) : 1;
  variant.method = method;
  if (everyEffect) return variant;
  variant.pointLights = !scene.lights.empty();
  variant.fill = scene.environment.diffuseFill > 0;
  variant.highlights = variant.pointLights && std::any_of(scene.materials.begin(), scene.materials.end(),
                                                          [](const auto& m) { return m.highlightStrength > 0; });
  variant.environmentMap = scene.environment.size > 0;
  return variant;
}

std::string preamble(const Variant& variant) {
  std::string text =
      "#extension GL_EXT_ray_tracing : require\n"
      "#extension GL_EXT_scalar_block_layout : require\n"
      "#extension GL_GOOGLE_include_directive : require\n";
  if (variant.stackSize > 0)
    text += fmt::format("#extension GL_EXT_ray_query : require\n#define MALUS_STACK_SIZE {}\n", variant.stackSize);
  text += fmt::format("#define MALUS_METHOD \"{}\"\n", variant.method);
  if (!variant.pointLights) text += "#define MALUS_NO_POINT_LIGHTS\n";
  if (!variant.fill) text += "#define MALUS_NO_FILL\n";
  if (!variant.highlights) text += "#define MALUS_NO_HIGHLIGHTS\n";
  if (!variant.environmentMap) text += "#define MALUS_NO_ENVIRONMENT_MAP\n";
  if (variant.countRays) text += "#define MALUS_COUNT_RAYS\n";
  if (variant.checkNumerics) text += "#define MALUS_CHECK_NUMERICS\n";
  return text;
}

const std::vector<StageSource>& stageSources(const Variant& variant) {
  static const std::vector<StageSource> kLoop = {{"shaders/stages/eye_path.rgen", Stage::raygen}};
  if (variant.stackSize > 0) return kLoop;
  static const std::vector<StageSource> kSources = {
      {"shaders/stages/raygen.rgen", Stage::raygen},     {"shaders/stages/environment.rmiss", Stage::miss},
      {"shaders/stages/shadow.rmiss", Stage::miss},      {"shaders/stages/lambert.rchit", Stage::closestHit},
      {"shaders/stages/paint.rchit", Stage::closestHit}, {"shaders/stages/metal.rchit", Stage::closestHit},
      {"shaders/stages/glass.rchit", Stage::closestHit}, {"shaders/stages/emitter.rchit", Stage::closestHit},
  };
  return kSources;
}

std::string_view includedSource(const Variant& variant, std::string_view path) {
  if (path != "shaders/methods/selected.h") return shaders::source(path);
  std::string file = variant.method;
  std::replace(file.begin(), file.end(), '-', '_');
  return shaders::source(fmt::format("shaders/{}/{}.h", variant.stackSize > 0 ? "loops" : "methods", file));
}

std::string stageText(const StageSource& source) {
  std::string text = "#version 460\n";
  for (const char* file : {"shaders/gpu/language.glsl", "shaders/optics/math.h", "shaders/optics/all.h",
                           "shaders/gpu/scene.h", "shaders/gpu/fault.h", "shaders/methods/selected.h"})
    text += fmt::format("#include \"{}\"\n", file);
  return text + fmt::format("#include \"{}\"\n", source.path);
}

}  // namespace malus::vulkan
