// Section TEXR: textures. Version 1 has three floats per texel. From version 2 on, whose textures are those of maps by
// texture coordinates, a channel that has few values is a list of them and a number per texel, so that images of 8 bits
// take a byte per texel and channel, whatever their encoding and the factors that were applied.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/pack/bytes.h"
#include "bake/pack/scene.h"

namespace malus::pack {

inline constexpr std::uint32_t kNewestTextures = 2;

// Version of the section that the materials need.
std::uint32_t texturesVersion(const std::vector<Material>& materials);

void writeTextures(ByteWriter& writer, std::uint32_t version, const std::vector<Texture>& textures);

// Throws Error: a count, a number or a texel out of range.
void readTextures(ByteReader reader, std::uint32_t version, std::vector<Texture>& textures);

}  // namespace malus::pack
