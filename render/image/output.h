// Image files of a render: EXR with every channel and its metadata, PNG for display.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bake/pack/reader.h"
#include "meshprep/base/image.h"
#include "render/scene/render_parameters.h"
#include "render/scene/render_result.h"

namespace malus::render {

// Channels R, G, B (behind the filter) and, if the result has them, S0.R ... S3.B; the attributes worldToCamera and
// malus:scene, pack, renderer, method, device, depth, samples, analyser, region, verticalFovDegrees or
// orthographicHeight.
image::Image toImage(const RenderResult& result, const pack::Pack& pack, const RenderParameters& parameters,
                     const std::string& renderer, const std::string& method);
// The same, and moves the pixels out of result.
image::Image takeImage(RenderResult& result, const pack::Pack& pack, const RenderParameters& parameters,
                       const std::string& renderer, const std::string& method);

// Returns the image with the channel A after R, G, B: coverage (render/embree/coverage.h), one value per pixel. The
// colours are not multiplied by it: they contain the environment behind a surface's edge.
image::Image withAlpha(const image::Image& image, const std::vector<float>& coverage);

// Converts the channels R, G, B from linear radiance to 8-bit sRGB: times 2^exposureEv, linear up to 0.7, above that an
// exponential shoulder that approaches 1, then the sRGB curve (IEC 61966-2-1).
std::vector<std::uint8_t> toneMapped(const image::Image& image, double exposureEv);

// Writes .exr or .png by the extension of path. exposureEv: of .png, in stops. compression: of .exr. Throws Error for
// another extension.
void writeImage(const std::filesystem::path& path, const image::Image& image, double exposureEv,
                image::ExrCompression compression = image::ExrCompression::zip);

}  // namespace malus::render
