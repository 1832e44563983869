#include "render/ground_truth/camera_matrices.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "render/scene/image_plane.h"

namespace malus::render {

namespace {

nlohmann::json rows(const glm::dmat4& m) {
  nlohmann::json list = nlohmann::json::array();
  for (int row = 0; row < 4; ++row) list.push_back({m[0][row], m[1][row], m[2][row], m[3][row]});
  return list;
}

}  // namespace

glm::dmat4 cameraToWorld(const pack::Scene& scene) {
  const pack::Camera& camera = scene.camera;
  return {glm::dvec4(camera.right, 0), glm::dvec4(camera.up, 0), glm::dvec4(-camera.forward, 0),
          glm::dvec4(camera.position + scene.origin, 1)};
}

// The axes are orthonormal: the inverse of their matrix is its transpose.
glm::dmat4 worldToCamera(const pack::Scene& scene) {
  const pack::Camera& camera = scene.camera;
  const glm::dvec3 position = camera.position + scene.origin, back = -camera.forward;
  return {{camera.right.x, camera.up.x, back.x, 0},
          {camera.right.y, camera.up.y, back.y, 0},
          {camera.right.z, camera.up.z, back.z, 0},
          {-glm::dot(position, camera.right), -glm::dot(position, camera.up), -glm::dot(position, back), 1}};
}

PixelIntrinsics pixelIntrinsics(const pack::Camera& camera, double width, double height) {
  const ImagePlane plane = makeImagePlane(camera, width, height);
  return {width / (2 * plane.halfWidth), height / (2 * plane.halfHeight),
          width / 2 - glm::dot(plane.middle, camera.right) * width / (2 * plane.halfWidth),
          height / 2 + glm::dot(plane.middle, camera.up) * height / (2 * plane.halfHeight)};
}

nlohmann::json cameraJson(const pack::Scene& scene, const RenderParameters& parameters) {
  const pack::Camera& camera = scene.camera;
  // Those of an orthographic camera are in pixels per metre.
  const PixelIntrinsics i = pixelIntrinsics(camera, parameters.width, parameters.height);
  nlohmann::json result = {{"width", parameters.width},
                           {"height", parameters.height},
                           {"cameraToWorld", rows(cameraToWorld(scene))},
                           {"worldToCamera", rows(worldToCamera(scene))},
                           {"convention",
                            "column vectors; camera axes: x right, y up, z toward the viewer; pixels from the upper "
                            "left corner, the centre of the first at (0.5, 0.5); metres"}};
  if (camera.isOrthographic()) {
    result["type"] = "orthographic";
    result["orthographicHeight"] = camera.orthographicHeight;
    result["pixelsPerMetre"] = {{"x", i.fx}, {"y", i.fy}};
    result["principalPoint"] = {{"x", i.cx}, {"y", i.cy}};
    result["intrinsics"] = nullptr;
    result["matrix"] = nullptr;
  } else {
    result["type"] = "perspective";
    result["orthographicHeight"] = nullptr;
    result["pixelsPerMetre"] = nullptr;
    result["principalPoint"] = nullptr;
    result["intrinsics"] = {{"fx", i.fx}, {"fy", i.fy}, {"cx", i.cx}, {"cy", i.cy}};
    result["matrix"] = {{i.fx, 0, i.cx}, {0, i.fy, i.cy}, {0, 0, 1}};
  }
  return result;
}

std::vector<float> exrWorldToCamera(const pack::Scene& scene) {
  const glm::dmat4 m = worldToCamera(scene);
  std::vector<float> values;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) values.push_back(static_cast<float>(m[column][row]));
  return values;
}

std::string regionText(const RenderParameters& parameters) {
  const Region& r = parameters.region;
  return fmt::format("{} {} {} {} of {} {}", r.x, r.y, r.width, r.height, parameters.width, parameters.height);
}

}  // namespace malus::render
