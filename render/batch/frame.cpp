#include "render/batch/frame.h"

#include <array>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bake/effects/effects.h"
#include "bake/pack/format.h"
#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"
#include "render/batch/camera_keys.h"
#include "render/ground_truth/camera_matrices.h"
#include "render/scene/methods.h"
#include "render/sensor/raw_output.h"

namespace malus::render {
using bake::StrictObject;
using nlohmann::json;

namespace {

// Keys of a frame whose values change the scene.
constexpr std::array kSurfaceKeys = {"wavelengthsNm", "materials", "lights", "environment"};

void readMethod(StrictObject& object, JobSettings& job) {
  if (!object.has("method")) return;
  const std::string name = object.text("method");
  const std::vector<std::string> known = methodNames();
  if (std::find(known.begin(), known.end(), name) == known.end())
    object.fail("method", fmt::format("unknown method '{}'{}", name, nearestClause(name, known)),
                fmt::format("{}", fmt::join(known, ", ")));
  job.method = name;
}

// "auto", "all", names separated by commas, or a list of names.
void readEffects(StrictObject& object, JobSettings& job) {
  if (!object.has("effects")) return;
  const json& value = object.at("effects");
  std::vector<std::string> names;
  if (value.is_array()) {
    for (const json& name : value) names.push_back(name.is_string() ? name.get<std::string>() : name.dump());
  } else {
    names = CLI::detail::split(object.text("effects"), ',');
  }
  if (names != std::vector<std::string>{"auto"} && names != std::vector<std::string>{"all"}) {
    const std::vector<std::string> known = bake::effectNames();
    for (std::string& name : names) try {
        name = shaders::effectName(bake::effectNamed(name));
      } catch (const Error&) {
        object.fail("effects", fmt::format("unknown effect '{}'{}", name, nearestClause(name, known)),
                    "auto, all, or names from --list-effects");
      }
  }
  job.effects = fmt::format("{}", fmt::join(names, ","));
}

void readNumbers(StrictObject& object, JobSettings& job) {
  job.width = object.integer("width", 1, pack::kMaxResolution, job.width);
  job.height = object.integer("height", 1, pack::kMaxResolution, job.height);
  if (object.has("depth")) job.depth = object.integer("depth", 0, pack::kMaxDepth);
  job.samples = object.integer("samples", 1, 64, job.samples);
  job.lightSamples = object.integer("lightSamples", 1, kMostLightSamples, job.lightSamples);
}

// A frame with one of the keys has the filter that they describe, else that of the options.
void readFilter(StrictObject& object, const FilterOptions& options, JobSettings& job) {
  FilterOptions filter;
  if (object.has("polarizer")) filter.polarizer = object.number("polarizer", -1e9, 1e9);
  if (object.has("analyser")) {
    filter.analyser = object.text("analyser");
    if (filter.analyser != "right" && filter.analyser != "left")
      object.fail("analyser", "unknown analyser", "'right' or 'left'", filter.analyser);
    if (filter.polarizer) object.fail("analyser", "excludes polarizer", "one of the two");
  }
  if (object.has("wavePlate")) {
    StrictObject plate = object.object("wavePlate");
    const double axis = plate.number("axisDegrees", -1e9, 1e9),
                 retardance = plate.number("retardanceDegrees", -1e9, 1e9, WavePlate{}.retardanceDegrees);
    filter.wavePlate = fmt::format("{},{}", axis, retardance);
    plate.finish();
  }
  job.analyser = makeAnalyser(filter.any() ? filter : options);
}

FrameOutputs readOutputs(StrictObject& object, const FrameOutputs& outputs, const std::string& where) {
  if (!object.has("outputs")) return outputs;
  const json& value = object.at("outputs");
  std::vector<std::string> names;
  if (value.is_string()) names = CLI::detail::split(value.get<std::string>(), ',');
  if (value.is_array())
    for (const json& name : value) names.push_back(name.is_string() ? name.get<std::string>() : name.dump());
  return {names, where};
}

void applyOutputs(StrictObject& object, const FrameOutputs& outputs, JobSettings& job) {
  const std::string reader = outputs.stokesOutput();
  job.needsLinear = !reader.empty();
  job.storesStokes = outputs.has(FrameOutput::exr);
  const bool hasStokes = !backendInfo(job.backend).hasMethods || methodNamed(job.method).hasStokes;
  job.stokes = job.needsLinear || job.storesStokes;
  if (!reader.empty() && !hasStokes)
    object.fail("method", fmt::format("'{}' has no Stokes vectors, which the output '{}' needs", job.method, reader),
                "stokes");
}

// The sensor of a frame, if an output needs it.
void readSensor(Frame& frame, const FrameDefaults& defaults, const std::string& where) {
  const std::string output = frame.outputs.sensorOutput();
  if (output.empty()) return;
  if (!defaults.sensor) throw Error(where, fmt::format("output '{}' needs a sensor", output), "--sensor FILE|PRESET");
  frame.sensor = defaults.sensor;
  frame.exposure = frameExposure(frame.exposureEv, frame.seed, frame.region);
  const auto period = static_cast<std::uint32_t>(patternPeriod(frame.sensor->pattern));
  const Region& r = frame.region;
  for (const std::uint32_t pixels : {r.width, r.height, r.x, r.y})
    if (pixels % period != 0)
      throw Error(where, "the image does not fit the pattern of the sensor",
                  fmt::format("a width, height and region of multiples of {} pixels", period), std::to_string(pixels));
}

// The conditions of a raw image, apart from the image.
json sensorJson(const Frame& frame) {
  if (!frame.sensor) return nullptr;
  json sensor = describeRaw({}, *frame.sensor, frame.exposure, nullptr);
  for (const char* key : {"malus", "width", "height", "saturatedPixels", "image"}) sensor.erase(key);
  return sensor;
}

json toJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Every setting by its value, so that frames that are made in the same way have the same text.
json settingsJson(const Frame& frame, const FrameDefaults& defaults, const RenderParameters& p,
                  const pack::Scene& scene) {
  const pack::Camera& c = frame.camera;
  return {{"backend", backendInfo(frame.job.backend).name},
          {"vulkanPath", static_cast<int>(p.vulkanPath)},
          {"embreePath", static_cast<int>(p.embreePath)},
          {"method", methodName(frame.job.backend, frame.job.method)},
          {"effects", frame.job.effects},
          {"width", p.width},
          {"height", p.height},
          {"region", {p.region.x, p.region.y, p.region.width, p.region.height}},
          {"depth", p.depth},
          {"samples", p.samples},
          {"lightSamples", p.lightSamples},
          {"analyser", p.analyser},
          {"exposure", frame.exposureEv},
          {"camera",
           {{"position", toJson(c.position + scene.origin)},
            {"right", toJson(c.right)},
            {"up", toJson(c.up)},
            {"forward", toJson(c.forward)},
            {"verticalFovDegrees", c.verticalFovDegrees},
            {"orthographicHeight", c.orthographicHeight},
            {"pixelAspect", c.pixelAspect},
            {"middle", {c.middleX, c.middleY}}}},
          {"scene", frame.surfaceKeys},
          {"outputs", frame.outputs.names()},
          {"sensor", sensorJson(frame)},
          {"compression", image::kExrCompressionNames[static_cast<std::size_t>(defaults.compression)]}};
}

}  // namespace

Exposure frameExposure(double exposureEv, std::uint64_t seed, const Region& region) {
  return {exposureEv, seed, 0, region.x, region.y};
}

Frame readFrame(const FrameJob& job, const FrameDefaults& defaults, const pack::Scene& scene) {
  Frame frame;
  frame.index = job.index;
  frame.name = job.name;
  frame.seed = job.seed;
  frame.job = defaults.job;
  StrictObject object(job.settings, job.where, "");
  readMethod(object, frame.job);
  readEffects(object, frame.job);
  readNumbers(object, frame.job);
  readFilter(object, defaults.filter, frame.job);
  frame.exposureEv = object.number("exposure", -100, 100, defaults.exposure.value_or(scene.exposureEv));
  frame.outputs = readOutputs(object, defaults.outputs, job.where);
  applyOutputs(object, frame.outputs, frame.job);
  RenderParameters parameters;
  try {
    parameters = renderParameters(frame.job, scene);
  } catch (const Error& error) {
    throw Error(job.where, error.what());
  }
  frame.region = parameters.region;
  readSensor(frame, defaults, job.where);
  frame.camera = scene.camera;
  if (object.has("camera"))
    frame.camera = readCamera(object.object("camera"), scene, parameters.width, parameters.height, job.where);
  frame.surfaces = readSurfaces(object, scene);
  object.finish();
  frame.surfaceKeys = json::object();
  for (const char* key : kSurfaceKeys)
    if (job.settings.contains(key)) frame.surfaceKeys[key] = job.settings.at(key);
  frame.settings = settingsJson(frame, defaults, parameters, scene);
  return frame;
}

}  // namespace malus::render
