// FLIP: perceived difference of two displayed images that are shown in turn. Source: Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astrom and Fairchild, FLIP: A Difference Evaluator for Alternating Images, Proc. ACM
// Computer Graphics and Interactive Techniques 3(2), 2020; all constants are the paper's.
#pragma once

#include <vector>

#include "render/scene/render_result.h"

namespace malus::render {

// The paper's observer, 0.7 m from a screen that is 0.7 m wide and has 3840 pixels in each row.
inline constexpr double kPixelsPerDegree = 0.7 * (3840 / 0.7) * 3.14159265358979323846 / 180;

// Of each pixel, from 0 (equal) to 1 (black against white), rows from the top. Arguments and errors as of meanFlip().
std::vector<double> flipValues(const RenderResult& image, const RenderResult& reference, double exposureEv,
                               double pixelsPerDegree = kPixelsPerDegree);

// Mean over the pixels, from 0 (equal) to 1 (black against white). Colours are linear sRGB times 2^exposureEv, clamped
// to [0, 1]; non-finite values count as 1. Throws Error if the sizes differ.
double meanFlip(const RenderResult& image, const RenderResult& reference, double exposureEv,
                double pixelsPerDegree = kPixelsPerDegree);

}  // namespace malus::render
