#include "render/sensor/sensor.h"

#include <cmath>

namespace malus::render {

double electronsPerNumber(const Sensor& sensor) {
  return sensor.gain.value_or(sensor.fullWell / (largestNumber(sensor) - sensor.blackLevel));
}

double electronsPerRadiance(const Sensor& sensor, double exposureEv) {
  return sensor.electronsPerRadiance.value_or(std::exp2(exposureEv) * sensor.fullWell);
}

Analyser polarizerRow(const Sensor& sensor, int channel, double degrees) {
  const double transmission = sensor.transmission[channel], leakage = 1 / sensor.extinctionRatio[channel];
  const Analyser ideal = linearPolarizer(degrees);
  return {transmission * (1 + leakage) * ideal[0], transmission * (1 - leakage) * ideal[1],
          transmission * (1 - leakage) * ideal[2], 0};
}

std::array<double, 3> channelWeights(const Sensor& sensor, int channel) {
  if (sensor.pattern == MosaicPattern::mono) return {sensor.response.x, sensor.response.y, sensor.response.z};
  std::array<double, 3> weights{};
  weights[static_cast<std::size_t>(channel)] = sensor.response[channel];
  return weights;
}

}  // namespace malus::render
