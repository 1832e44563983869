#include "render/scene/effects_choice.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "bake/effects/polarization_bound.h"
#include "render/scene/methods.h"

namespace malus::render {

using shaders::Effect;

namespace {

// Name of the method that replaces this one if linear, or circular, polarization is not needed.
std::string withoutPolarization(const MethodInfo& method, bool linear, bool circular) {
  if (linear) return method.withoutLinear;
  return circular ? method.withoutCircular : method.name;
}

// Chooses the cheapest exact method. If Stokes vectors are requested it carries them, even if they are 0.
EffectsChoice chooseAutomatically(const MethodInfo& method, const std::vector<pack::Effect>& effects,
                                  const bake::ImageRequest& request) {
  EffectsChoice choice;
  choice.method = method.name;
  if (method.accuracy == Accuracy::approximate) return choice;
  const bool linear = request.linearStokes || bake::isOn(effects, Effect::kLinearPolarization),
             circular = bake::isOn(effects, Effect::kCircularPolarization);
  choice.method = withoutPolarization(method, !linear, !circular);
  if (choice.method != method.name)
    choice.why =
        !linear ? "polarization does not change this image" : "circular polarization does not change this image";
  return choice;
}

// Warning that an effect is left out, with a bound of the error.
std::string warningText(Effect effect, const pack::Scene& scene, const bake::ImageRequest& request) {
  std::string size = "the error can be as large as its light";
  if (isPolarization(effect)) {
    const glm::dvec3 bound = bake::polarizationErrorBound(scene, request);
    size =
        bake::isUseful(bound)
            ? fmt::format("the relative error of the unpolarized intensity is at most {:.3g}, {:.3g}, {:.3g} (r, g, b)",
                          bound.x, bound.y, bound.z)
            : "there is no useful bound of the error of the unpolarized intensity ('malus compare --effects' measures "
              "it)";
  }
  return fmt::format("--effects leaves out {0}, which this scene needs: {1}; add {0} to --effects to keep it",
                     shaders::effectName(effect), size);
}

}  // namespace

bool isPolarization(Effect effect) {
  return effect == Effect::kLinearPolarization || effect == Effect::kCircularPolarization;
}

EffectsChoice chooseEffects(const std::vector<std::string>& asked, const std::string& method, const pack::Scene& scene,
                            const bake::ImageRequest& request) {
  EffectsChoice choice;
  choice.method = method;
  if (asked.size() == 1 && asked[0] == "all") return choice;
  const std::vector<pack::Effect> effects = bake::findEffects(scene, request);
  if (asked.size() == 1 && asked[0] == "auto") return chooseAutomatically(methodNamed(method), effects, request);

  std::set<Effect> kept = {Effect::kTir};  // follows from dielectric interfaces
  for (const std::string& name : asked) kept.insert(bake::effectNamed(name));
  std::set<Effect> off;
  for (const pack::Effect& e : effects)
    if (e.on && !kept.contains(bake::effectNamed(e.name))) {
      off.insert(bake::effectNamed(e.name));
      choice.off.push_back(e.name);
    }
  choice.method = withoutPolarization(methodNamed(method), off.contains(Effect::kLinearPolarization),
                                      off.contains(Effect::kCircularPolarization));
  // A method that is not replaced carries no polarization or keeps it, so polarization causes no warning.
  for (const Effect effect : off)
    if (!isPolarization(effect) || choice.method != method)
      choice.warnings.push_back({effect, warningText(effect, scene, request)});
  return choice;
}

}  // namespace malus::render
