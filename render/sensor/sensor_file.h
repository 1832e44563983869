// Reads the description of a sensor: a JSON file by the schema of render/sensor/SENSOR.md, or a preset.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "render/sensor/sensor.h"

namespace malus::render {

// Names of the presets, sorted.
std::vector<std::string> sensorPresets();

// name: a preset, or else a file. A name that contains neither a dot nor a slash is a preset. Throws Error that names
// the file and the key: a file that cannot be read, an unknown key or preset, a value of another type or out of range.
Sensor readSensor(const std::string& name);

// The same of a document, such as sensorDocument() returns. location: of errors.
Sensor readSensorDocument(const nlohmann::json& document, const std::string& location);

// Every key of a sensor by its value.
nlohmann::json sensorDocument(const Sensor& sensor);

// Whether readSensor() reads a file of this name.
bool isSensorFile(const std::string& name);

}  // namespace malus::render
