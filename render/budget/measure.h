// Measurements of every choice on a small image, cached in the user's cache folder.
#pragma once

#include <string>

#include "bake/pack/reader.h"
#include "render/budget/combination.h"
#include "render/progress.h"
#include "render/renderer_pool.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

// A small image of the same view: at most this many pixels on the longer side, one sample per pixel; the region in
// proportion.
inline constexpr std::uint32_t kSmallSide = 256;
RenderParameters smallParameters(const RenderParameters& full);

// Measures methods, effects, depths and tolerances (combination.h) on a small image, or reads earlier measurements of
// the same pack, view, filter, device and version. leaveOutEffects: effects and depths too, else methods and tolerances
// alone. threads: of the reference, 0 for all. Leaves out methods that the device cannot render by, and what has not
// been started after `minutes`, for devices that compile a choice for minutes; such measurements are not cached. Throws
// Error if the complete method does not render.
inline constexpr double kFirstPassMinutes = 10;
Measurements measureChoices(const pack::Pack& pack, const RenderParameters& full, RendererPool& renderers,
                            unsigned threads, bool leaveOutEffects, const Progress& progress,
                            double minutes = kFirstPassMinutes);

}  // namespace malus::render
