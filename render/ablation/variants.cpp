#include "render/ablation/variants.h"

#include <algorithm>

#include <fmt/format.h>

#include "bake/effects/effects.h"
#include "render/scene/effects_choice.h"
#include "render/scene/left_out.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

using shaders::Effect;

// The depths that are measured below the complete one, from the largest.
std::vector<std::uint32_t> shorterDepths(std::uint32_t depth) {
  std::vector<std::uint32_t> depths;
  // Half of them are the last bounces; the step doubles before.
  for (std::uint32_t next = depth, step = 1; next > 0 && depths.size() < kMostBounces;) {
    if (depth > kMostBounces && depths.size() >= kMostBounces / 2) step *= 2;
    next = next > step ? next - step : 0;
    depths.push_back(next);
  }
  return depths;
}

Variant depthVariant(const Variant& complete, std::uint32_t depth) {
  Variant variant = complete;
  variant.kind = VariantKind::depth;
  variant.name = fmt::format("bounce {}", depth + 1);
  variant.parameters.depth = depth;
  return variant;
}

Variant samplesVariant(const Variant& complete, std::uint32_t samples) {
  Variant variant = complete;
  variant.kind = VariantKind::samples;
  variant.name = fmt::format("{} of {} light samples", samples, complete.parameters.lightSamples);
  variant.parameters.lightSamples = samples;
  return variant;
}

}  // namespace

const char* variantKindName(VariantKind kind) {
  switch (kind) {
    case VariantKind::complete:
      return "complete";
    case VariantKind::effect:
      return "effect";
    case VariantKind::polarization:
      return "polarization";
    case VariantKind::depth:
      return "depth";
    case VariantKind::samples:
      return "samples";
  }
  return "";
}

std::vector<Variant> ablationVariants(const pack::Scene& scene, const RenderParameters& parameters) {
  const MethodInfo& complete = completeRecursiveMethod();
  std::vector<Variant> variants = {{VariantKind::complete, "", complete.name, parameters, nullptr}};
  const Variant first = variants.front();
  const bake::ImageRequest request{parameters.depth, parameters.analyser, false, false};
  const std::vector<pack::Effect> found = bake::findEffects(scene, request);
  std::vector<Variant> effects;
  for (const pack::Effect& effect : found) {
    const Effect which = bake::effectNamed(effect.name);
    if (!effect.on || which == Effect::kTir) continue;  // total reflection follows from dielectric interfaces
    Variant variant = first;
    variant.name = effect.name;
    if (isPolarization(which)) {
      variant.kind = VariantKind::polarization;
      variant.method = which == Effect::kLinearPolarization ? complete.withoutLinear : complete.withoutCircular;
      variants.push_back(std::move(variant));
      continue;
    }
    variant.kind = VariantKind::effect;
    variant.scene = leaveOut(scene, {effect.name}, variant.parameters);
    effects.push_back(std::move(variant));
  }
  variants.insert(variants.end(), effects.begin(), effects.end());
  for (const std::uint32_t depth : shorterDepths(parameters.depth)) variants.push_back(depthVariant(first, depth));
  if (bake::isOn(found, Effect::kAreaLights) || bake::isOn(found, Effect::kEnvironmentLight))
    for (std::uint32_t samples = parameters.lightSamples / 2; samples > 0; samples /= 2)
      variants.push_back(samplesVariant(first, samples));
  return variants;
}

}  // namespace malus::render
