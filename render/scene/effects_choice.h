// `--effects`: which effects a picture is rendered with, and the cheapest method that is exact for them.
#pragma once

#include <string>
#include <vector>

#include "bake/effects/effects.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

struct EffectsChoice {
  std::string method;                 // the one asked for, or a cheaper one that makes the same picture
  std::string why;                    // of a cheaper one; else empty
  std::vector<std::string> off;       // effects that the scene has and that were left out on purpose
  std::vector<std::string> warnings;  // what is missing then, and how large the error can be
};

// What a user may say: "auto" (what the scene calls for), "all" (every effect is compiled in), or a list of the effects
// to keep, by name. Throws Error for an unknown effect.
//
// request: what is asked of the picture. With "auto" a method that carries polarized light is replaced where polarized
// light cannot show: `stokes` and its like by `fresnel`, or by `stokes-linear` where only circular light cannot;
// `importance` by `fresnel-iterative`. Both are exact then.
EffectsChoice chooseEffects(const std::vector<std::string>& asked, const std::string& method, const pack::Scene& scene,
                            const bake::ImageRequest& request);

}  // namespace malus::render
