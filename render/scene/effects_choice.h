// --effects: the effects that an image is rendered with, and the cheapest method that is exact for them.
#pragma once

#include <string>
#include <vector>

#include "bake/effects/effects.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

struct EffectWarning {
  shaders::Effect effect;  // left out although the scene needs it
  std::string text;        // with a bound of the error
};

struct EffectsChoice {
  std::string method;                   // the requested one, or a cheaper one that renders the same image
  std::string why;                      // reason for the cheaper method; else empty
  std::vector<std::string> off;         // effects that the scene needs and that are left out, by name
  std::vector<EffectWarning> warnings;  // one per effect whose absence changes the image
};

// Whether the effect is linear or circular polarization, which depends on the method.
bool isPolarization(shaders::Effect effect);

// asked: "auto" (what the scene needs), "all" (every effect is compiled in), or the names of the effects to keep.
// Throws Error for an unknown effect.
//
// request: settings of the image. With "auto" an exact method is replaced by the cheaper one of its row in
// shaders/methods.def if linear, or only circular, polarization cannot change the image; the result is exact.
EffectsChoice chooseEffects(const std::vector<std::string>& asked, const std::string& method, const pack::Scene& scene,
                            const bake::ImageRequest& request);

}  // namespace malus::render
