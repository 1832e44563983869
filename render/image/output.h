// A rendered picture as files: EXR with every channel and its metadata, PNG for the eye.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bake/pack/reader.h"
#include "meshprep/base/image.h"
#include "render/scene/render_parameters.h"
#include "render/scene/render_result.h"

namespace malus::render {

// Channels R, G, B (behind the filter) and, where the picture has them, S0.R ... S3.B; the attributes
// worldToCamera and malus:scene, pack, renderer, method, device, depth, samples, analyser, region,
// verticalFovDegrees.
image::Image toImage(const RenderResult& picture, const pack::Pack& pack, const RenderParameters& parameters,
                     const std::string& renderer, const std::string& method);

// 8-bit sRGB of linear radiance: times 2^exposureEv, linear up to 0.7, then an exponential shoulder that
// reaches 1 at infinity, then the sRGB curve (IEC 61966-2-1). Takes channels R, G, B.
std::vector<std::uint8_t> toneMapped(const image::Image& image, double exposureEv);

// By the extension of path: .exr or .png. Throws Error for another.
void writeImage(const std::filesystem::path& path, const image::Image& image, double exposureEv);

}  // namespace malus::render
