#include "render/batch/frame_description.h"

#include <algorithm>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "render/batch/tiles.h"
#include "render/sensor/sensor_file.h"

namespace malus::render {
using nlohmann::json;

namespace {

constexpr int kVersion = 1;

// A text, a number, a list of numbers, or {"bytes": [...]} for a text that is not UTF-8, which JSON cannot contain.
json toJson(const image::Image::Value& value) {
  const auto* const text = std::get_if<std::string>(&value);
  if (text == nullptr) return std::visit([](const auto& plain) { return json(plain); }, value);
  try {
    json result = *text;
    static_cast<void>(result.dump());
    return result;
  } catch (const json::type_error&) {
    return {{"bytes", std::vector<unsigned char>(text->begin(), text->end())}};
  }
}

image::Image::Value toValue(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.get<double>();
  if (value.is_array()) return value.get<std::vector<float>>();
  const auto bytes = value.at("bytes").get<std::vector<unsigned char>>();
  return std::string(bytes.begin(), bytes.end());
}

json describeImage(const image::Image& image) {
  if (image.channels.empty()) return nullptr;
  json attributes = json::array();
  for (const auto& [name, value] : image.attributes) attributes.push_back({{"name", name}, {"value", toJson(value)}});
  return {{"channels", image.channels}, {"attributes", attributes}};
}

image::Image readImage(const json& description, const Region& region) {
  image::Image image;
  if (description.is_null()) return image;
  image.width = static_cast<int>(region.width);
  image.height = static_cast<int>(region.height);
  image.channels = description.at("channels").get<std::vector<std::string>>();
  for (const json& attribute : description.at("attributes"))
    image.attributes.emplace_back(attribute.at("name"), toValue(attribute.at("value")));
  return image;
}

image::ExrCompression compressionNamed(const std::string& name) {
  const auto* const found = std::ranges::find(image::kExrCompressionNames, name);
  if (found == image::kExrCompressionNames.end()) throw std::runtime_error("another compression");
  return static_cast<image::ExrCompression>(found - image::kExrCompressionNames.begin());
}

FrameDescription read(const json& document, const ManifestEntry& entry, const std::string& where) {
  if (document.at("malusFrame") != kVersion) throw std::runtime_error("another version");
  FrameDescription result;
  Frame& frame = result.frame;
  frame.index = entry.index;
  frame.name = entry.name;
  frame.seed = entry.seed;
  frame.settings = entry.settings;
  frame.exposureEv = entry.settings.at("exposure");
  frame.outputs = settingsOutputs(entry.settings);
  frame.region = settingsRegion(entry.settings);
  if (!document.at("sensor").is_null()) {
    frame.sensor = std::make_shared<const Sensor>(readSensorDocument(document.at("sensor"), where));
    frame.exposure = frameExposure(frame.exposureEv, frame.seed, frame.region);
  }
  result.compression = compressionNamed(entry.settings.at("compression"));
  result.rendered.method = entry.method;
  result.rendered.camera = document.at("camera");
  result.rendered.image = readImage(document.at("image"), frame.region);
  result.rendered.truth = readImage(document.at("truth"), frame.region);
  return result;
}

}  // namespace

std::string frameDescriptionName(const std::string& frame) { return frame + ".frame.json"; }

json describeFrame(const Frame& frame, const RenderedFrame& tile) {
  return {{"malusFrame", kVersion},
          {"camera", tile.camera},
          {"image", describeImage(tile.image)},
          {"truth", describeImage(tile.truth)},
          {"sensor", frame.sensor ? sensorDocument(*frame.sensor) : json()}};
}

FrameDescription readFrameDescription(const std::filesystem::path& file, const ManifestEntry& entry) {
  const std::string text = readTextFile(file);
  try {
    return read(json::parse(text), entry, file.string());
  } catch (const Error&) {
    throw;
  } catch (const std::exception&) {
    throw Error(file.string(), "is not a description of the frame", "a file of 'malus batch --tiles', or a new folder");
  }
}

}  // namespace malus::render
