#include "render/scene/effects_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "bake/effects/polarization_bound.h"
#include "meshprep/base/error.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

bool contains(const std::vector<std::string>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

// Name of the method that replaces this one if linear, or circular, polarization is not needed.
std::string withoutPolarization(const MethodInfo& method, bool linear, bool circular) {
  if (linear) return method.withoutLinear;
  return circular ? method.withoutCircular : method.name;
}

}  // namespace

EffectsChoice chooseEffects(const std::vector<std::string>& asked, const std::string& method, const pack::Scene& scene,
                            const bake::ImageRequest& request) {
  EffectsChoice choice;
  choice.method = method;
  const std::vector<pack::Effect> effects = bake::findEffects(scene, request);
  const bool all = asked.size() == 1 && asked[0] == "all", automatic = asked.size() == 1 && asked[0] == "auto";
  if (all) return choice;
  if (automatic) {
    // Who asks for Stokes vectors gets a method that has them, though they may be 0.
    const bool linear = request.linearStokes || bake::isOn(effects, "linear-polarization"),
               circular = bake::isOn(effects, "circular-polarization");
    const MethodInfo& info = methodNamed(method);
    if (info.accuracy == Accuracy::approximate) return choice;
    choice.method = withoutPolarization(info, !linear, !circular);
    if (choice.method != method)
      choice.why =
          !linear ? "polarized light cannot show in this picture" : "circular light cannot show in this picture";
    return choice;
  }

  // A list: what it does not name is left out.
  const std::vector<std::string> known = bake::effectNames();
  for (const std::string& name : asked)
    if (!contains(known, name))
      throw Error("--effects", fmt::format("unknown effect '{}'", name),
                  fmt::format("auto, all, or some of {}", fmt::join(known, ", ")));
  for (const pack::Effect& e : effects)
    if (e.on && !contains(asked, e.name) && e.name != "tir") choice.off.push_back(e.name);
  choice.method = withoutPolarization(methodNamed(method), contains(choice.off, "linear-polarization"),
                                      contains(choice.off, "circular-polarization"));
  for (const std::string& name : choice.off) {
    std::string size = "the error can be as large as the light that it makes";
    if (name == "linear-polarization" || name == "circular-polarization") {
      if (choice.method == method) continue;  // this method carries none, or keeps it all the same
      const glm::dvec3 bound = bake::polarizationErrorBound(scene, request);
      size = fmt::format("the intensity can be off by {:.3g}, {:.3g}, {:.3g} of the unpolarized one (r, g, b)", bound.x,
                         bound.y, bound.z);
    }
    choice.warnings.push_back(fmt::format("--effects leaves out {}, which this scene needs: {}", name, size));
  }
  return choice;
}

}  // namespace malus::render
