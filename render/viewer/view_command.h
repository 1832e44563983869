// The view as a command line of `malus render` and as a camera of scene.json.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "render/viewer/view_state.h"

namespace malus::viewer {

// {"position", "target", "up"} in world space, with the projection: the key `camera` of scene.json and of a job of
// `malus batch`, and the value of `malus render --view`. Numbers have 17 digits, so that the camera is the same.
nlohmann::json cameraKeys(const pack::Camera& camera, const glm::dvec3& origin);

struct ViewedFile {
  std::string pack;  // as on the command line
  glm::dvec3 origin{0.0};
  std::vector<pack::Effect> needed;
};

// The command that renders what a side shows, into `output`: quoted for a shell.
std::string renderCommand(const ViewState& state, const SideSettings& side, const ViewedFile& file, std::uint32_t width,
                          std::uint32_t height, const std::string& output);

// Replaces the key `camera` of a scene.json and keeps everything else. Throws Error: not a JSON object, a file that
// cannot be read or written.
void saveCamera(const std::string& sceneFile, const pack::Camera& camera, const glm::dvec3& origin);

}  // namespace malus::viewer
