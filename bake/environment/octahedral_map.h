// From a latitude-longitude picture to what a pack keeps: an octahedral map (no trigonometry when it is
// looked up) and the irradiance that it gives diffuse surfaces. +y is up, the picture's centre column looks
// toward -z, columns to its right toward +x.
#pragma once

#include "bake/pack/scene.h"
#include "meshprep/base/image.h"

namespace malus::bake {

// Fills size, texels (with their border) and irradiance. Radiance is multiplied by scale; the picture is
// turned by rotationDegrees counter-clockwise about +y seen from above. The map's side is the picture's
// height, at most 1024. Throws Error where the picture has no R, G, B or a negative or non-finite value.
void bakeEnvironment(const image::Image& picture, std::string_view where, double scale, double rotationDegrees,
                     pack::Environment& environment);

// The irradiance of a constant environment.
void bakeConstantEnvironment(const glm::dvec3& radiance, pack::Environment& environment);

// The same under Rayleigh's phase function (shaders/optics/sky.h); sun: unit, toward it.
void bakeRayleighIrradiance(const glm::dvec3& sun, pack::Environment& environment);

}  // namespace malus::bake
