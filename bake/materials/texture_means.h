// The means of the textures of imported materials, which stand for the textures.
#pragma once

#include "meshprep/read/source_scene.h"

namespace malus::bake {

// Multiplies the factors of the materials by the means of their images over all pixels, decoded by their role as glTF
// requires (sRGB or linear, metadata of the file ignored; of a material that blends also alpha, by which
// its colours are weighted). An image that cannot be read leaves a note, and is removed; its factors are used alone.
// But the emission of a material is left out then, because most of a mask of emission is black. strict: such an image
// is an Error.
void applyTextureMeans(prep::SourceScene& scene, bool strict);

}  // namespace malus::bake
