// Pictures that stand for numbers of materials.
#pragma once

#include "bake/pack/scene.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/base/image.h"

namespace malus::bake {

// Texels from a picture: linear (a picture that says or implies sRGB is decoded; IEC 61966-2-1), times scale, plus
// offset. A picture of one or two channels is grey. name: for messages and the pack. Throws Error: too large, a value
// outside of what the material's number may be.
pack::Texture bakeTexture(const image::Image& picture, const TextureDescription& description, const std::string& name);

}  // namespace malus::bake
