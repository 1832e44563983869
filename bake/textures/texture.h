// Textures of materials, baked from images.
#pragma once

#include <string>
#include <vector>

#include "bake/pack/scene.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/base/image.h"

namespace malus::bake {

// Returns the texels of an image: the linear colours of an albedo (meshprep/base/image_colour.h), the stored values of
// an index, times scale, plus offset. Adds what is not applied to notes. name: for the pack. Throws Error: too large,
// no colour, or a value outside the bounds of the material's number.
pack::Texture bakeTexture(const image::Image& image, const TextureDescription& description, const std::string& name,
                          std::vector<std::string>& notes);

}  // namespace malus::bake
