// The conclusion of an ablation for one effect, in numbers and in words.
#pragma once

#include <string>

#include "render/ablation/ablation.h"

namespace malus::render {

// An invisible error: bounds of the relative RMS, of the share of pixels with an error above 1 %, and of the
// mean FLIP. (A mean FLIP of 0.01 is about the least that the authors of FLIP call noticeable in flickered images.)
inline constexpr double kInvisibleRelRms = 1e-3, kInvisibleShare = 1e-4, kInvisibleFlip = 1e-3;
bool isInvisible(const ImageError& error);

// Share of the time that is saved without an effect, over the relative RMS error that this causes, which is taken as
// 1e-9 at least. The larger, the sooner it should be left out; negative if nothing is saved.
double costPerError(double savedShare, const ImageError& error);

// Share of the complete image's time that a row saves; 0 if the difference is not significant.
double savedShare(const AblationRow& row);

// One sentence: what is lost without the effect, what it costs, what to do. Without a full stop.
std::string advice(const AblationRow& row);

}  // namespace malus::render
