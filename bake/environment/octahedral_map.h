// Bakes a latitude-longitude image into an octahedral map, whose lookup needs no trigonometry, and the irradiance that
// it gives diffuse surfaces. +y is up, the centre column of the image is toward -z, columns to its right toward +x.
#pragma once

#include "bake/pack/scene.h"
#include "meshprep/base/image.h"

namespace malus::bake {

// Fills size, texels (with their border) and irradiance. Radiance is multiplied by scale; the image is
// rotated by rotationDegrees counter-clockwise about +y seen from above. The side of the map is the height of the
// image, at most 1024. Throws Error if the image lacks R, G or B or has a negative or non-finite value.
void bakeEnvironment(const image::Image& image, std::string_view where, double scale, double rotationDegrees,
                     pack::Environment& environment);

// Sets the irradiance of a constant environment.
void bakeConstantEnvironment(const glm::dvec3& radiance, pack::Environment& environment);

// The same under Rayleigh's phase function (shaders/optics/sky.h); sun: unit vector toward the sun.
void bakeRayleighIrradiance(const glm::dvec3& sun, pack::Environment& environment);

}  // namespace malus::bake
