#include "bake/model/model_scene.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "bake/model/framing.h"
#include "bake/pack/format.h"
#include "bake/scene_file/scene_keys.h"
#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"
#include "meshprep/read/counted_note.h"

namespace malus::bake {

namespace {

// A name by the rules of scene.json: letters, digits and '-'.
std::string sceneName(const std::filesystem::path& file) {
  std::string name = file.stem().string().substr(0, 100);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
  return name.empty() ? "model" : name;
}

std::vector<std::string> cameraNames(const std::vector<prep::SourceCamera>& cameras) {
  std::vector<std::string> names;
  names.reserve(cameras.size());
  for (const prep::SourceCamera& camera : cameras) names.push_back(camera.name);
  return names;
}

// The camera with this name, of its node or its own, or this number from 0. Throws Error.
const prep::SourceCamera& findCamera(const SceneDescription& d, const std::vector<prep::SourceCamera>& cameras,
                                     const std::string& wanted) {
  for (const auto& name : {&prep::SourceCamera::name, &prep::SourceCamera::objectName})
    for (const prep::SourceCamera& camera : cameras)
      if (camera.*name == wanted) return camera;
  std::size_t index = 0;
  const auto [end, failed] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (failed == std::errc() && end == wanted.data() + wanted.size() && index < cameras.size()) return cameras[index];
  const std::vector<std::string> names = cameraNames(cameras);
  throw Error(d.file.string(), fmt::format("has no camera '{}'{}", wanted, nearestClause(wanted, names)),
              cameras.empty() ? "no --camera: the file has none"
                              : fmt::format("--camera with a number below {}, or one of '{}'", cameras.size(),
                                            fmt::join(names, "', '")));
}

// Sets the longer side to kModelPixels.
void setSize(SceneDescription& d, double aspect) {
  const auto shorter = [](double ratio) {
    return static_cast<std::uint32_t>(std::max(1.0, std::round(kModelPixels * ratio)));
  };
  d.width = aspect >= 1 ? kModelPixels : shorter(aspect);
  d.height = aspect >= 1 ? shorter(1 / aspect) : kModelPixels;
}

void useCamera(SceneDescription& d, const prep::SourceCamera& camera, const glm::dvec3& centre) {
  const std::string location = fmt::format("{}: camera '{}'", d.file.string(), camera.name);
  const double fov = camera.verticalFov * 180 / std::numbers::pi;
  if (!camera.isOrthographic && !(fov >= kLeastFovDegrees && fov <= kMostFovDegrees))
    throw Error(location, "has a vertical field of view out of range",
                fmt::format("{:g} to {:g} degrees; choose another camera, or --camera {}", kLeastFovDegrees,
                            kMostFovDegrees, kFramingCamera),
                fmt::format("{:g}", fov));
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(camera.position[i]) <= kMaxSceneLength / 2))
      throw Error(location, "is out of range", fmt::format("coordinates up to {:g} m", kMaxSceneLength / 2),
                  fmt::format("{:g}", camera.position[i]));
  if (camera.isOrthographic)
    d.orthographicHeight = camera.height;
  else
    d.verticalFovDegrees = fov;
  d.cameraPosition = camera.position;
  d.cameraUp = camera.up;
  // A target at the depth of the model is easier to edit than one near the camera.
  const double depth = glm::dot(centre - camera.position, camera.forward);
  d.cameraTarget = camera.position + camera.forward * (depth > 0 ? depth : 1.0);
  setSize(d, camera.aspect.value_or(kModelAspect));
}

void setCamera(SceneDescription& d, const ModelContents& contents, std::vector<std::string>& choices) {
  const std::string& wanted = d.model->camera;
  const std::vector<prep::SourceCamera>& cameras = contents.cameras;
  const glm::dvec3 centre = contents.low + (contents.high - contents.low) * 0.5;
  const std::vector<std::string> names = cameraNames(cameras);
  const bool asksToFrame = wanted == kFramingCamera && std::ranges::find(names, wanted) == names.end();
  if (asksToFrame || (cameras.empty() && wanted.empty())) {
    const FramingView view = frameBox(contents.low, contents.high, kModelAspect);
    d.cameraPosition = view.position;
    d.cameraTarget = view.target;
    d.verticalFovDegrees = kFramingFovDegrees;
    setSize(d, kModelAspect);
    choices.push_back(cameras.empty() ? "camera: a three-quarter view of the whole model, because the file has none"
                                      : "camera: a three-quarter view of the whole model");
    return;
  }
  const prep::SourceCamera& camera = wanted.empty() ? cameras.front() : findCamera(d, cameras, wanted);
  useCamera(d, camera, centre);
  choices.push_back(cameras.size() == 1 ? fmt::format("camera: '{}' of the file", camera.name)
                                        : fmt::format("camera: '{}'; --camera selects another of {}", camera.name,
                                                      prep::countedNote("those of the file", cameras.size(), names)));
}

// Photometric units are those of the scene: candela become W/sr and lux W/m^2 as the cd/m^2 of emissive materials
// become W/(m^2 sr), so that the ratios of all lights are those of the file.
void setLights(SceneDescription& d, const ModelContents& contents, std::vector<std::string>& notes) {
  using Kind = prep::SourceLight::Kind;
  std::vector<std::string> outOfRange;
  for (const prep::SourceLight& source : contents.lights) {
    const double largest = std::max({source.intensity.x, source.intensity.y, source.intensity.z});
    if (largest <= 0) continue;
    if (largest > kMaxSceneLight || d.lights.size() == pack::kMaxLights) {
      outOfRange.push_back(source.name);
      continue;
    }
    pack::LightSource& light = d.lights.emplace_back();
    light.kind = source.kind == Kind::point  ? pack::LightKind::point
                 : source.kind == Kind::spot ? pack::LightKind::spot
                                             : pack::LightKind::directional;
    light.intensity = source.intensity;
    if (source.kind != Kind::directional) light.position = source.position;
    if (source.kind != Kind::point) light.direction = source.direction;
    if (source.kind == Kind::spot) {
      light.innerConeDegrees = source.innerConeAngle * 180 / std::numbers::pi;
      light.outerConeDegrees = std::min(source.outerConeAngle * 180 / std::numbers::pi, 90.0);
    }
  }
  if (!outOfRange.empty())
    notes.push_back(
        fmt::format("{}: left out: {}", d.file.string(),
                    prep::countedNote("lights beyond the limits of a scene", outOfRange.size(), outOfRange)));
}

void setEnvironment(SceneDescription& d, std::vector<std::string>& choices) {
  if (!d.environmentImage.empty()) {
    d.ambientIrradiance = 1;
    d.environmentIlluminates = true;
  } else if (d.lights.empty()) {
    // The key light is to the left of the camera, wherever that is.
    const glm::dvec3 toCamera = d.cameraPosition - d.cameraTarget;
    const double azimuth = std::atan2(toCamera.x, toCamera.z) * 180 / std::numbers::pi;
    d.environmentPreset = kStudioPreset;
    d.environmentRotationDegrees = std::round(azimuth);
    d.ambientIrradiance = 1;
    d.environmentIlluminates = true;
  }
  const std::string image = d.environmentImage.filename().string();
  choices.push_back(
      fmt::format("light: {}", !d.environmentImage.empty() && !d.lights.empty()
                                   ? fmt::format("lights of the file ({}) and {}", d.lights.size(), image)
                               : !d.lights.empty() ? fmt::format("lights of the file ({})", d.lights.size())
                               : !image.empty()    ? image
                                                   : "the studio, because the file has no light that can be used"));
}

}  // namespace

bool isModelFile(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 6> kExtensions = {".gltf", ".glb", ".obj", ".ply", ".stl", ".off"};
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::ranges::find(kExtensions, extension) != kExtensions.end();
}

SceneDescription describeModel(const std::filesystem::path& file, const ModelOptions& options) {
  SceneDescription d;
  d.file = file;
  d.name = sceneName(file);
  d.title = file.filename().string();
  d.depth = kUnmeasuredDepth;
  d.environmentImage = options.environment;
  ImportDescription& import = d.imports.emplace_back();
  import.file = file;
  import.usesViews = true;
  import.preparation.weldRelative = kModelWeldRelative;
  d.model = ModelRequest{options.camera};
  return d;
}

void completeModel(SceneDescription& d, const ModelContents& contents, std::vector<std::string>& notes,
                   std::vector<std::string>& choices) {
  for (int i = 0; i < 3; ++i)
    for (const double x : {contents.low[i], contents.high[i]})
      if (!(std::abs(x) <= kMaxSceneLength / 16))
        throw Error(d.file.string(), "the model is out of range",
                    fmt::format("coordinates up to {:g} m", kMaxSceneLength / 16), fmt::format("{:g}", x));
  setCamera(d, contents, choices);
  setLights(d, contents, notes);
  setEnvironment(d, choices);
}

void applyModelProbe(const DepthProbe& probe, SceneDescription& d, pack::Scene& scene,
                     std::vector<std::string>& choices) {
  std::uint32_t depth = kLeastModelDepth;
  while (depth < kMostModelDepth && shareBeyond(probe.beyond, depth) > kModelLostLight) ++depth;
  d.depth = scene.depth = depth;
  choices.push_back(fmt::format("depth: {}, beyond which {:.2g} % of the light arrives", depth,
                                100 * shareBeyond(probe.beyond, depth)));
  const std::vector<double>& pixels = probe.pixelRadiance;
  if (!pixels.empty() && std::ranges::all_of(pixels, [](double x) { return !(x > 0); })) {
    choices.emplace_back(
        "image: black, as no light reaches a diffuse surface; metal and glass reflect an environment (--environment)");
  } else if (d.environmentPreset.empty()) {
    d.exposureEv = scene.exposureEv = measuredExposure(probe.pixelRadiance);
    choices.push_back(fmt::format("exposure: {:+g} stops, measured on a small image", d.exposureEv));
  }
}

double measuredExposure(std::vector<double> pixels) {
  constexpr double kShown = 0.8, kShare = 0.95;
  std::erase_if(pixels, [](double x) { return !(x > 0); });
  if (pixels.empty()) return 0;
  const auto at = pixels.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(pixels.size() - 1));
  std::nth_element(pixels.begin(), at, pixels.end());
  return std::clamp(std::round(2 * std::log2(kShown / *at)) / 2, -100.0, 100.0);
}

}  // namespace malus::bake
