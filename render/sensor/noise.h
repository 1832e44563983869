// Charge of a pixel: shot noise and full well.
#pragma once

#include "render/sensor/philox.h"
#include "render/sensor/sensor.h"

namespace malus::render {

// Returns a charge of the distribution of Poisson with a mean [e-], or the mean without shot noise, at most the full
// well. A mean that is negative or NaN gives 0.
double drawCharge(const Sensor& sensor, double mean, PhiloxStream& random);

// Returns a value of the read noise [e-].
double drawReadNoise(const Sensor& sensor, PhiloxStream& random);

}  // namespace malus::render
