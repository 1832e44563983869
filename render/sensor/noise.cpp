#include "render/sensor/noise.h"

#include <algorithm>
#include <cstdint>
#include <random>

namespace malus::render {

double drawCharge(const Sensor& sensor, double mean, PhiloxStream& random) {
  if (!(mean > 0)) return 0;
  // Charges below the full well are then improbable by more than 10^-100.
  if (mean > 4 * sensor.fullWell + 1000) return sensor.fullWell;
  const double charge =
      sensor.shotNoise ? static_cast<double>(std::poisson_distribution<std::int64_t>(mean)(random)) : mean;
  return std::min(charge, sensor.fullWell);
}

double drawReadNoise(const Sensor& sensor, PhiloxStream& random) {
  if (!(sensor.readNoise > 0)) return 0;
  return std::normal_distribution<double>(0, sensor.readNoise)(random);
}

}  // namespace malus::render
