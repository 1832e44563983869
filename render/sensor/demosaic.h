// From the raw image of a sensor back to Stokes vectors.
#pragma once

#include <array>

#include "meshprep/base/image.h"
#include "render/sensor/expose.h"
#include "render/sensor/sensor.h"

namespace malus::render {

// Pseudo-inverse of the four rows of Mueller matrices of a channel: the least-squares Stokes vector (S0, S1, S2) of the
// light behind four micro-polarizers, in the order of kPolarizerDegrees (J. S. Tyo et al., "Review of passive imaging
// polarimetry for remote sensing applications", Applied Optics 45, 2006).
using DataReduction = std::array<std::array<double, kPolarizerAngles>, 3>;
DataReduction dataReduction(const Sensor& sensor, int channel);

// Subtracts black level and dark signal, divides by gain, exposure and response, interpolates each colour and each
// angle bilinearly, and applies the data reduction matrix, which compensates extinction ratio and transmission. A
// colour is first interpolated among the pixels of one angle, by the mean of the two or four nearest, then the angles.
// Samples beyond the border are those of the border, so that only linear images at least 4 pixels from it are exact; 2
// pixels with `mono`.
//
// Returns radiance: of a colour sensor R, G, B (S0) and S0.R ... S2.B, of a monochrome one Y (S0), S0.Y, S1.Y and S2.Y.
// S3 is not measured. Saturated pixels are used as they were read. exposureEv: as in Exposure.
image::Image demosaic(const RawImage& raw, const Sensor& sensor, double exposureEv);

}  // namespace malus::render
