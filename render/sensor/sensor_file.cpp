#include "render/sensor/sensor_file.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/scene_file/json_file.h"
#include "bake/scene_file/key_reader.h"
#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"
#include "render/sensor/sensor_keys.h"

namespace malus::render {
using nlohmann::json;

// Generated from render/sensor/presets by the build.
extern const std::string_view kImx250mzr, kImx250myr;

namespace {

struct Preset {
  const char* name;
  const std::string_view& text;
};
const Preset kPresets[] = {{"imx250myr", kImx250myr}, {"imx250mzr", kImx250mzr}};

std::string quotedPresets() { return fmt::format("'{}'", fmt::join(sensorPresets(), "', '")); }

// location: of the error if the preset is unknown.
json presetDocument(const std::string& name, const std::string& location) {
  for (const Preset& preset : kPresets)
    if (name == preset.name) return json::parse(preset.text);
  throw Error(location, fmt::format("unknown preset '{}'{}", name, nearestClause(name, sensorPresets())),
              quotedPresets() + " or a file with the extension .json");
}

// A value that a monochrome sensor has once.
void requireOne(bake::StrictObject& top, const char* key, const glm::dvec3& value) {
  if (value.x != value.y || value.x != value.z)
    top.fail(key, "has several values", "one number for the pattern 'mono'",
             fmt::format("[{:g}, {:g}, {:g}]", value.x, value.y, value.z));
}

void checkValues(bake::StrictObject& top, const Sensor& sensor) {
  const bool isMono = sensor.pattern == MosaicPattern::mono;
  for (int c = 0; c < 3; ++c) {
    if (!isMono && sensor.response[c] == 0) top.fail("response", "is out of range", "three numbers over 0", "0");
    if (sensor.transmission[c] == 0) top.fail("transmission", "is out of range", "over 0, up to 1", "0");
  }
  if (sensor.response == glm::dvec3(0)) top.fail("response", "measures no light", "a weight over 0", "[0, 0, 0]");
  if (isMono) {
    requireOne(top, "transmission", sensor.transmission);
    requireOne(top, "extinctionRatio", sensor.extinctionRatio);
  }
  if (std::ranges::find(kSensorBits, sensor.bits) == kSensorBits.end())
    top.fail("bits", "is not a supported size", fmt::format("{}", fmt::join(kSensorBits, ", ")),
             fmt::format("{}", sensor.bits));
  if (sensor.blackLevel >= largestNumber(sensor))
    top.fail("blackLevel", "is out of range", fmt::format("under {:g}, the largest number", largestNumber(sensor)),
             fmt::format("{:g}", sensor.blackLevel));
}

// Sets the key of each field; a value without a key is not set.
class KeyWriter {
 public:
  explicit KeyWriter(json& document) : document_(document) {}
  template <class T>
  void operator()(const pack::Field& field, const std::optional<T>& value) {
    if (value) (*this)(field, *value);
  }
  template <class T>
  void operator()(const pack::Field& field, const T& value) {
    json& key = document_[std::string(field.name)];
    if constexpr (std::is_same_v<T, glm::dvec3>)
      key = {value.x, value.y, value.z};
    else
      key = value;
  }

 private:
  json& document_;
};

}  // namespace

Sensor readSensorDocument(const json& document, const std::string& location) {
  Sensor sensor;
  bake::StrictObject top(document, location, "");
  top.integer("malus", 1, 1);
  const std::string pattern = top.text("pattern");
  const auto* const found = std::ranges::find(kMosaicPatternNames, pattern);
  if (found == kMosaicPatternNames.end())
    top.fail("pattern", "unknown pattern", fmt::format("'{}'", fmt::join(kMosaicPatternNames, "', '")),
             fmt::format("'{}'", pattern));
  sensor.pattern = static_cast<MosaicPattern>(found - kMosaicPatternNames.begin());
  sensor.bits = top.integer("bits", kSensorBits.front(), kSensorBits.back());
  visitSensorKeys(bake::KeyReader(top), sensor);
  checkValues(top, sensor);
  top.finish();
  return sensor;
}

json sensorDocument(const Sensor& sensor) {
  json document = {
      {"malus", 1}, {"pattern", kMosaicPatternNames[static_cast<std::size_t>(sensor.pattern)]}, {"bits", sensor.bits}};
  visitSensorKeys(KeyWriter(document), sensor);
  return document;
}

std::vector<std::string> sensorPresets() {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) names.emplace_back(preset.name);
  return names;
}

bool isSensorFile(const std::string& name) { return name.find_first_of("./") != std::string::npos; }

Sensor readSensor(const std::string& name) {
  if (!isSensorFile(name)) return readSensorDocument(presetDocument(name, "--sensor"), "preset " + name);
  json document = bake::readJsonFile(name, "the schema of render/sensor/SENSOR.md");
  bake::StrictObject top(document, name, "");
  if (top.has("preset")) {
    json merged = presetDocument(top.text("preset"), name);
    top.integer("malus", 1, 1);
    document.erase("preset");
    merged.update(document);
    document = std::move(merged);
  }
  return readSensorDocument(document, name);
}

}  // namespace malus::render
