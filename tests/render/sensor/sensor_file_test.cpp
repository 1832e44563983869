// Descriptions of sensors: presets, and errors that name the file and the key.
#include "render/sensor/sensor_file.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "meshprep/base/error.h"

namespace malus::render {
namespace {

using nlohmann::json;
// Tests of several processes run at once.
const std::string kFile =
    (std::filesystem::path(testing::TempDir()) / fmt::format("sensor_file_test-{}.json", ::getpid())).string();

Sensor read(const std::string& text) {
  std::ofstream(kFile) << text;
  return readSensor(kFile);
}
Sensor read(const json& document) { return read(document.dump()); }

const json kMono = {{"malus", 1},
                    {"pattern", "mono"},
                    {"response", {0.2, 0.7, 0.1}},
                    {"extinctionRatio", 100},
                    {"fullWell", 10000},
                    {"readNoise", 2.5},
                    {"bits", 12}};

json with(json document, const char* key, json value) {
  document[key] = std::move(value);
  return document;
}

std::string error(const json& document) {
  try {
    read(document);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

void expectError(const json& document, const std::string& key, const std::string& expected) {
  const std::string text = error(document);
  EXPECT_NE(text.find(kFile), std::string::npos) << text;
  EXPECT_NE(text.find(key), std::string::npos) << text;
  EXPECT_NE(text.find(expected), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST(SensorFile, ReadsEveryKey) {
  const json document = {{"malus", 1},
                         {"name", "n"},
                         {"source", "s"},
                         {"pattern", "quad-bayer"},
                         {"response", {0.2, 0.7, 0.1}},
                         {"transmission", {0.5, 0.6, 0.7}},
                         {"extinctionRatio", {10, 20, 30}},
                         {"fullWell", 10000},
                         {"readNoise", 2.5},
                         {"darkSignal", 3},
                         {"shotNoise", false},
                         {"bits", 10},
                         {"blackLevel", 60},
                         {"gain", 9},
                         {"electronsPerRadiance", 4000}};
  const Sensor s = read(document);
  EXPECT_EQ(s.name + s.source, "ns");
  EXPECT_EQ(s.pattern, MosaicPattern::quadBayer);
  EXPECT_EQ(s.response, glm::dvec3(0.2, 0.7, 0.1));
  EXPECT_EQ(s.transmission, glm::dvec3(0.5, 0.6, 0.7));
  EXPECT_EQ(s.extinctionRatio, glm::dvec3(10, 20, 30));
  EXPECT_EQ(s.fullWell, 10000);
  EXPECT_EQ(s.readNoise, 2.5);
  EXPECT_EQ(s.darkSignal, 3);
  EXPECT_FALSE(s.shotNoise);
  EXPECT_EQ(s.bits, 10u);
  EXPECT_EQ(s.blackLevel, 60);
  EXPECT_EQ(electronsPerNumber(s), 9);
  EXPECT_EQ(electronsPerRadiance(s, 5), 4000);
  EXPECT_EQ(sensorDocument(s), document);
}

// A sensor is that of its document, also without the optional keys.
TEST(SensorFile, WritesEveryKey) {
  for (const json& document : {kMono, with(kMono, "gain", 0.1), with(kMono, "darkSignal", 1.0 / 3)}) {
    const Sensor sensor = read(document),
                 again = readSensorDocument(json::parse(sensorDocument(sensor).dump()), "test");
    EXPECT_EQ(sensorDocument(again), sensorDocument(sensor));
    EXPECT_EQ(again.gain, sensor.gain);
    EXPECT_EQ(again.electronsPerRadiance, sensor.electronsPerRadiance);
    EXPECT_EQ(again.darkSignal, sensor.darkSignal);
    EXPECT_EQ(again.transmission, glm::dvec3(1));
  }
}

TEST(SensorFile, HasDefaults) {
  const Sensor s = read(kMono);
  EXPECT_EQ(s.transmission, glm::dvec3(1));
  EXPECT_EQ(s.extinctionRatio, glm::dvec3(100));
  EXPECT_TRUE(s.shotNoise);
  EXPECT_EQ(s.darkSignal, 0);
  EXPECT_EQ(electronsPerNumber(s), 10000.0 / 4095);
  EXPECT_EQ(electronsPerRadiance(s, -1), 5000);
}

TEST(SensorFile, PresetsAreReadAndCanBeChanged) {
  EXPECT_EQ(sensorPresets(), (std::vector<std::string>{"imx250myr", "imx250mzr"}));
  EXPECT_EQ(readSensor("imx250mzr").pattern, MosaicPattern::mono);
  EXPECT_EQ(readSensor("imx250myr").pattern, MosaicPattern::quadBayer);
  for (const std::string& name : sensorPresets()) {
    const Sensor s = readSensor(name);
    EXPECT_EQ(s.bits, 12u);
    EXPECT_NE(s.source.find("Teledyne"), std::string::npos);
    EXPECT_NE(s.source.find("not published"), std::string::npos);
    // The dynamic range of the same table.
    EXPECT_NEAR(20 * std::log10(s.fullWell / s.readNoise), 76.4, 0.05);
  }
  const Sensor changed =
      read({{"malus", 1}, {"preset", "imx250myr"}, {"readNoise", 5}, {"bits", 8}, {"blackLevel", 4}});
  EXPECT_EQ(changed.readNoise, 5);
  EXPECT_EQ(changed.bits, 8u);
  EXPECT_EQ(changed.pattern, MosaicPattern::quadBayer);
  EXPECT_EQ(changed.fullWell, readSensor("imx250myr").fullWell);
}

TEST(SensorFile, RefusesWrongValues) {
  for (const auto& [key, value] : kMono.items()) {
    json missing = kMono;
    missing.erase(key);
    expectError(missing, key, "missing");
  }
  for (const char* key : {"fullWell", "readNoise", "darkSignal", "blackLevel", "gain", "electronsPerRadiance", "bits",
                          "extinctionRatio", "transmission", "response"}) {
    expectError(with(kMono, key, "12"), key, "must be");
    expectError(with(kMono, key, nullptr), key, "must be");
    expectError(with(kMono, key, -1), key, key == std::string("response") ? "vector" : "range");
  }
  expectError(with(kMono, "response", {1, -1, 0}), "response", "range");
  expectError(with(kMono, "response", {0, 0, 0}), "response", "no light");
  expectError(with(kMono, "response", {1, 1}), "response", "three");
  expectError(with(kMono, "extinctionRatio", {100, 200, 300}), "extinctionRatio", "one number");
  expectError(with(kMono, "transmission", {1, 1, 0.5}), "transmission", "one number");
  expectError(with(kMono, "extinctionRatio", 1), "extinctionRatio", "range");
  expectError(with(kMono, "transmission", 0), "transmission", "range");
  expectError(with(kMono, "transmission", 1.1), "transmission", "range");
  expectError(with(kMono, "gain", 0), "gain", "range");
  expectError(with(kMono, "electronsPerRadiance", 0), "electronsPerRadiance", "range");
  expectError(with(kMono, "fullWell", 0), "fullWell", "range");
  expectError(with(kMono, "blackLevel", 4095), "blackLevel", "range");
  expectError(with(kMono, "bits", 9), "bits", "8, 10, 12, 16");
  expectError(with(kMono, "bits", 12.5), "bits", "whole number");
  expectError(with(kMono, "shotNoise", 1), "shotNoise", "true or false");
  expectError(with(kMono, "name", 1), "name", "text");
  expectError(with(kMono, "pattern", "bayer"), "pattern", "quad-bayer");
  expectError(with(kMono, "malus", 2), "malus", "range");
  expectError(with(with(kMono, "pattern", "quad-bayer"), "response", {1, 0, 1}), "response", "over 0");
}

TEST(SensorFile, RefusesUnknownNames) {
  expectError(with(kMono, "readnoise", 1), "readnoise", "'readNoise'");
  expectError(with(kMono, "quantumEfficiency", 1), "quantumEfficiency", "unknown key");
  expectError({{"malus", 1}, {"preset", "imx250mzz"}}, "imx250mzz", "imx250mzr");
  expectError({{"malus", 1}, {"preset", "imx250mzr"}, {"reedNoise", 1}}, "reedNoise", "'readNoise'");
  expectError({{"preset", "imx250mzr"}}, "malus", "missing");
  expectError({{"malus", 1}, {"preset", 3}}, "preset", "text");
  expectError(json::array(), "top level", "object");
  EXPECT_THROW(read(std::string("{\"malus\": 1, \"malus\": 1}")), Error);
  EXPECT_THROW(read(std::string("{")), Error);
  EXPECT_THROW(readSensor("imx250"), Error);
  EXPECT_THROW(readSensor("nowhere/sensor.json"), Error);
}

}  // namespace
}  // namespace malus::render
