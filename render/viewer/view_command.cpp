#include "render/viewer/view_command.h"

#include <fstream>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/json_text.h"
#include "render/scene/methods.h"

namespace malus::viewer {

namespace {

// In single quotes, which a quote inside ends, escapes and opens again.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

nlohmann::json list(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

void appendFilter(std::string& command, const FilterState& filter) {
  if (filter.kind == FilterKind::linear) command += fmt::format(" --polarizer {}", filter.polarizerDegrees);
  if (filter.kind == FilterKind::right) command += " --analyser right";
  if (filter.kind == FilterKind::left) command += " --analyser left";
  if (filter.hasPlate && filter.kind != FilterKind::none)
    command += fmt::format(" --wave-plate {},{}", filter.plate.axisDegrees, filter.plate.retardanceDegrees);
}

}  // namespace

nlohmann::json cameraKeys(const pack::Camera& camera, const glm::dvec3& origin) {
  const glm::dvec3 position = camera.position + origin;
  nlohmann::json keys = {
      {"position", list(position)}, {"target", list(position + camera.forward)}, {"up", list(camera.up)}};
  if (camera.isOrthographic())
    keys["orthographicHeight"] = camera.orthographicHeight;
  else
    keys["verticalFovDegrees"] = camera.verticalFovDegrees;
  return keys;
}

std::string renderCommand(const ViewState& state, const SideSettings& side, const ViewedFile& file, std::uint32_t width,
                          std::uint32_t height, const std::string& output) {
  const render::JobSettings job = jobSettings(state, side, width, height, file.needed);
  std::string command =
      fmt::format("malus render {} -o {} --view {} --width {} --height {}", quoted(file.pack), quoted(output),
                  quoted(cameraKeys(state.camera, file.origin).dump()), width, height);
  command += fmt::format(" --backend {}", render::backendInfo(side.backend).name);
  if (render::backendInfo(side.backend).hasMethods) command += fmt::format(" --method {}", side.method);
  if (job.stokes) command += " --stokes";
  command += fmt::format(" --depth {} --samples {} --light-samples {} --exposure {} --effects {}", state.depth,
                         state.samples, state.lightSamples, state.exposureEv, job.effects);
  appendFilter(command, state.filter);
  return command;
}

void saveCamera(const std::string& sceneFile, const pack::Camera& camera, const glm::dvec3& origin) {
  std::ifstream in(sceneFile);
  if (!in) throw Error(sceneFile, "cannot open", "a scene.json");
  nlohmann::ordered_json scene = nlohmann::ordered_json::parse(in, nullptr, false);
  if (!scene.is_object()) throw Error(sceneFile, "is not a JSON object", "a scene.json");
  scene["camera"] = cameraKeys(camera, origin);
  const std::string text = scene.dump(2) + "\n";
  writeFile(sceneFile, std::as_bytes(std::span(text)));
}

}  // namespace malus::viewer
