// A polarization sensor, from the command line: --sensor and its outputs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "meshprep/base/image.h"
#include "meshprep/base/output_files.h"
#include "render/scene/render_parameters.h"
#include "render/sensor/sensor.h"

namespace malus::render {

struct SensorOptions {
  std::string sensor;             // a preset or a file; empty: no sensor
  std::string raw, mask, stokes;  // files to write, or empty
  std::uint32_t seed = 0, frame = 0;

  bool any() const { return !sensor.empty(); }
};

// --sensor
CLI::Option* addSensor(CLI::App& command, std::string& sensor);
// --sensor, its outputs and its noise
void addSensorOptions(CLI::App& command, SensorOptions& options);

// Registers the files that the sensor reads and writes.
void addSensorFiles(OutputFiles& files, const SensorOptions& options);

// Checks extensions, and that a sensor has an output. Throws CLI::ValidationError.
void checkSensorOptions(const SensorOptions& options);

// Reads the sensor; nothing without --sensor. Throws Error.
std::optional<Sensor> readSensor(const SensorOptions& options);

// Throws CLI::ValidationError unless the region fits the pattern of the sensor.
void checkSensorRegion(const Sensor& sensor, const Region& region);

// Exposes the sensor and writes what was asked for. image: with Stokes channels. scene: keys about the image for the
// JSON file beside the raw image. Returns the names of the files. Throws Error.
std::vector<std::string> writeSensorOutputs(const SensorOptions& options, const Sensor& sensor,
                                            const image::Image& image, const Region& region, double exposureEv,
                                            const nlohmann::json& scene, image::ExrCompression compression);

}  // namespace malus::render
