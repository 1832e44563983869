// Bakes a latitude-longitude image into an octahedral map, whose lookup needs no trigonometry, and the irradiance that
// it gives diffuse surfaces. +y is up, the centre column of the image is toward -z, columns to its right toward +x.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"
#include "meshprep/base/image.h"

namespace malus::bake {

// Fills size, texels (with their border), storage and irradiance. Colours are made linear
// (meshprep/base/image_colour.h, whose notes are added). Radiance is multiplied by scale; the image is rotated by
// rotationDegrees counter-clockwise about +y seen from above. The side of the map is the height of the image or half
// its width, 64 to 1024; texels are means over their area. The irradiance is that of the interpolated image, the light
// of which the map contains. Throws Error if the image has no colour, or a radiance that is negative, not finite or
// above pack::kMaxLight.
void bakeEnvironment(const image::Image& image, std::string_view where, double scale, double rotationDegrees,
                     pack::Environment& environment, std::vector<std::string>& notes);

// Sets the irradiance of a constant environment.
void bakeConstantEnvironment(const glm::dvec3& radiance, pack::Environment& environment);

// The same under Rayleigh's phase function (shaders/optics/sky.h); sun: unit vector toward the sun.
void bakeRayleighIrradiance(const glm::dvec3& sun, pack::Environment& environment);

// The texel in column i of row j of a map with its border: -1 to size.
glm::vec3& octahedralTexel(pack::Environment& environment, int i, int j);

// Sets the border, which repeats the texels across the edges of the map.
void fillOctahedralBorder(pack::Environment& environment);

}  // namespace malus::bake
