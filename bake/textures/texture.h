// Textures of materials, baked from images.
#pragma once

#include "bake/pack/scene.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/base/image.h"

namespace malus::bake {

// Returns the texels of an image: decoded from sRGB (IEC 61966-2-1) if it is an albedo and the file states or implies
// sRGB, times scale, plus offset. An image of one or two channels is grey. name: for the pack. Throws Error: too large,
// or a value outside the bounds of the material's number.
pack::Texture bakeTexture(const image::Image& image, const TextureDescription& description, const std::string& name);

}  // namespace malus::bake
