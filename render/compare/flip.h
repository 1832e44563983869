// FLIP: how different two displayed pictures look to a person who flips between them. Source: Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astrom and Fairchild, FLIP: A Difference Evaluator for Alternating Images, Proc. ACM
// Computer Graphics and Interactive Techniques 3(2), 2020; all constants are the paper's.
#pragma once

#include "render/scene/render_result.h"

namespace malus::render {

// The paper's observer: 0.7 m before a screen 0.7 m wide with 3840 pixels across.
inline constexpr double kPixelsPerDegree = 0.7 * (3840 / 0.7) * 3.14159265358979323846 / 180;

// Mean over the pixels, 0 (the same) to 1 (black against white). Colours are linear sRGB times 2^exposureEv, cut to
// [0, 1] as a display does; what is not finite counts as 1. Throws Error where the sizes differ.
double meanFlip(const RenderResult& picture, const RenderResult& reference, double exposureEv,
                double pixelsPerDegree = kPixelsPerDegree);

}  // namespace malus::render
