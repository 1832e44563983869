// Images behind the filter, on the CPU: for errors and saved files. The display pass does the same on the device.
#pragma once

#include "render/scene/render_parameters.h"
#include "render/scene/render_result.h"
#include "render/viewer/published.h"

namespace malus::viewer {

// Colours behind the filter, three channels; those of an image without Stokes vectors, which is rendered with the
// filter, are returned. The image must be complete.
render::RenderResult filteredColours(const ImageRows& image, const render::Analyser& analyser);

// Every channel, with the colours behind the filter.
render::RenderResult filteredImage(const ImageRows& image, const render::Analyser& analyser);

}  // namespace malus::viewer
