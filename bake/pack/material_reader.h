// The materials of a scene pack: sections MATL and SRFX.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/pack/bytes.h"
#include "bake/pack/scene.h"

namespace malus::pack {

// Fills the materials with the fields of MATL. Throws Error.
void readMaterials(ByteReader reader, std::vector<Material>& materials);

// Fills in the fields of SRFX of a version. The textures must have been read: their values must be within the bounds of
// what they replace. Throws Error.
void readSurfaces(ByteReader reader, std::uint32_t version, const std::vector<Texture>& textures,
                  std::vector<Material>& materials);

}  // namespace malus::pack
