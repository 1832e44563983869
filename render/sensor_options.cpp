#include "render/sensor_options.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/console.h"
#include "meshprep/base/nearest_name.h"
#include "meshprep/json_text.h"
#include "meshprep/number_option.h"
#include "meshprep/output_option.h"
#include "render/sensor/expose.h"
#include "render/sensor/raw_output.h"
#include "render/sensor/sensor_file.h"

namespace malus::render {

namespace {

void requireExtension(const char* option, const std::string& file, std::initializer_list<const char*> extensions) {
  const std::filesystem::path extension = std::filesystem::path(file).extension();
  if (file.empty() || std::any_of(extensions.begin(), extensions.end(), [&](const char* e) { return extension == e; }))
    return;
  throw CLI::ValidationError(option, fmt::format("expected {}, found {}", fmt::join(extensions, " or "), file));
}

}  // namespace

CLI::Option* addSensor(CLI::App& command, std::string& sensor) {
  return command
      .add_option("--sensor", sensor,
                  "Polarization sensor that the image falls on: a .json file, imx250mzr or imx250myr")
      ->type_name("FILE|PRESET");
}

void addSensorOptions(CLI::App& command, SensorOptions& options) {
  CLI::Option* sensor = addSensor(command, options.sensor);
  const auto add = [&](const char* name, std::string& file, const char* description) {
    command.add_option(name, file, description)->check(outputName())->type_name("FILE")->needs(sensor);
  };
  add("--sensor-raw", options.raw,
      "Raw image of the sensor: .png, .tif or .exr (digital numbers), with a .json of the same name");
  add("--sensor-mask", options.mask, "Saturated pixels of the sensor: .png, 255 if saturated");
  add("--sensor-stokes", options.stokes,
      "Stokes vectors from the raw image, demosaicked, with the polarizers' extinction compensated: .exr");
  const auto addInteger = [&](const char* name, std::uint32_t& value, const char* description) {
    command.add_option(name, value, description)
        ->transform(wholeNumberBetween(0, 4294967295u))
        ->capture_default_str()
        ->needs(sensor);
  };
  addInteger("--sensor-seed", options.seed, "Seed of the sensor's noise");
  addInteger("--sensor-frame", options.frame, "Number of the frame; frames of one seed have independent noise");
}

void addSensorFiles(OutputFiles& files, const SensorOptions& options) {
  if (isSensorFile(options.sensor)) files.addInput(options.sensor);
  files.addOutput(options.raw, "--sensor-raw");
  if (!options.raw.empty()) files.addOutput(rawDescriptionFile(options.raw), "--sensor-raw");
  files.addOutput(options.mask, "--sensor-mask");
  files.addOutput(options.stokes, "--sensor-stokes");
}

void checkSensorOptions(const SensorOptions& options) {
  if (options.any() && options.raw.empty() && options.mask.empty() && options.stokes.empty())
    throw CLI::ValidationError("--sensor", "needs an output; use --sensor-raw, --sensor-mask or --sensor-stokes");
  requireExtension("--sensor-raw", options.raw, {".png", ".tif", ".tiff", ".exr"});
  requireExtension("--sensor-mask", options.mask, {".png"});
  requireExtension("--sensor-stokes", options.stokes, {".exr"});
}

std::optional<Sensor> readSensor(const SensorOptions& options) {
  if (!options.any()) return std::nullopt;
  if (!isSensorFile(options.sensor)) {
    const std::vector<std::string> presets = sensorPresets();
    if (std::ranges::find(presets, options.sensor) == presets.end())
      throw CLI::ValidationError(
          "--sensor", fmt::format("expected a file with the extension .json or one of {}{}, found {}",
                                  fmt::join(presets, ", "), nearestClause(options.sensor, presets), options.sensor));
  }
  return readSensor(options.sensor);
}

void checkSensorRegion(const Sensor& sensor, const Region& region) {
  const auto period = static_cast<std::uint32_t>(patternPeriod(sensor.pattern));
  const auto check = [&](const char* quantity, const char* option, std::uint32_t a, std::uint32_t b) {
    if (a % period != 0 || b % period != 0)
      throw CLI::ValidationError("--sensor", fmt::format("needs {} that are multiples of {} ({}), found {} x {}",
                                                         quantity, period, option, a, b));
  };
  check("a width and height", "--width, --height", region.width, region.height);
  check("coordinates of the region", "--region", region.x, region.y);
}

std::vector<std::string> writeSensorOutputs(const SensorOptions& options, const Sensor& sensor,
                                            const image::Image& image, const Region& region, double exposureEv,
                                            const nlohmann::json& scene, image::ExrCompression compression) {
  const Exposure exposure{exposureEv, options.seed, options.frame, region.x, region.y};
  console::progress("exposing the sensor");
  const RawImage raw = expose(image, sensor, exposure);
  std::vector<std::string> written;
  const auto write = [&](const std::string& output, const auto& writer) {
    if (output.empty()) return;
    console::progress(fmt::format("writing {}", output));
    writer(output);
    written.push_back(output);
  };
  write(options.raw, [&](const std::string& file) { writeRaw(file, raw, sensor); });
  write(options.raw.empty() ? "" : rawDescriptionFile(options.raw).string(),
        [&](const std::string& file) { writeFile(file, jsonText(describeRaw(raw, sensor, exposure, scene)) + "\n"); });
  write(options.mask, [&](const std::string& file) { writeSaturation(file, raw); });
  write(options.stokes,
        [&](const std::string& file) { writeSensorStokes(file, raw, sensor, exposureEv, image, compression); });
  return written;
}

}  // namespace malus::render
