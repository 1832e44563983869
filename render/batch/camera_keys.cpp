#include "render/batch/camera_keys.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "bake/camera.h"
#include "bake/pack/format.h"
#include "bake/scene_file/key_reader.h"
#include "bake/scene_file/scene_keys.h"
#include "meshprep/base/error.h"

namespace malus::render {
using bake::StrictObject;

namespace {

// Largest deviation of the axes of a pose from orthonormal ones: poses are written with few digits.
constexpr double kPoseTolerance = 1e-3;

// Rows of a matrix; the fourth must be 0 0 0 1.
std::array<glm::dvec4, 3> readRows(StrictObject& object, const nlohmann::json& pose) {
  const auto isRow = [](const nlohmann::json& row) {
    return row.is_array() && row.size() == 4 &&
           std::all_of(row.begin(), row.end(), [](const nlohmann::json& v) { return v.is_number(); });
  };
  const bool isMatrix =
      pose.is_array() && (pose.size() == 3 || pose.size() == 4) && std::all_of(pose.begin(), pose.end(), isRow);
  if (!isMatrix) object.fail("pose", "is not a matrix", "3 or 4 rows of 4 numbers");
  if (pose.size() == 4 && pose[3] != nlohmann::json({0, 0, 0, 1}))
    object.fail("pose", "has a fourth row that is not that of a motion", "[0, 0, 0, 1]", pose[3].dump());
  std::array<glm::dvec4, 3> rows;
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; k < 4; ++k) {
      rows[i][k] = pose[i][static_cast<std::size_t>(k)].get<double>();
      if (!(std::abs(rows[i][k]) <= bake::kMaxSceneLength))
        object.fail("pose", "is out of range", fmt::format("numbers up to {:g}", bake::kMaxSceneLength));
    }
  return rows;
}

void readPose(StrictObject& object, const pack::Scene& scene, pack::Camera& camera) {
  const std::array<glm::dvec4, 3> rows = readRows(object, object.at("pose"));
  const auto column = [&](int k) { return glm::dvec3(rows[0][k], rows[1][k], rows[2][k]); };
  const glm::dmat3 axes(column(0), column(1), column(2)), product = glm::transpose(axes) * axes;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r)
      if (std::abs(product[c][r] - (c == r ? 1 : 0)) > kPoseTolerance)
        object.fail("pose", "has axes that are not orthonormal", "a rotation and a translation");
  if (glm::determinant(axes) < 0) object.fail("pose", "mirrors the scene", "a rotation, of determinant 1");
  camera.position = column(3) - scene.origin;
  camera.forward = glm::normalize(-column(2));
  camera.right = glm::normalize(glm::cross(camera.forward, column(1)));
  camera.up = glm::cross(camera.right, camera.forward);
}

void readPlace(StrictObject& object, const pack::Scene& scene, const std::string& where, pack::Camera& camera) {
  const bool hasPosition = object.has("position"), hasTarget = object.has("target"), hasUp = object.has("up");
  if (object.has("pose")) {
    if (hasPosition || hasTarget || hasUp)
      object.fail("pose", "excludes position, target and up", "a pose, or position and target");
    readPose(object, scene, camera);
    return;
  }
  if (!hasPosition && !hasTarget && !hasUp) return;
  const double most = bake::kMaxSceneLength;
  const glm::dvec3 position = object.vector("position", -most, most), target = object.vector("target", -most, most);
  const glm::dvec3 up = hasUp ? bake::readDirection(object, "up") : glm::dvec3(0, 1, 0);
  bake::placeCamera(position, target, up, where, camera);
  camera.position = position - scene.origin;
}

void readProjection(StrictObject& object, double width, double height, const std::string& where, pack::Camera& camera) {
  const bool hasFov = object.has("verticalFovDegrees"), hasHeight = object.has("orthographicHeight"),
             hasIntrinsics = object.has("intrinsics");
  if (int{hasFov} + int{hasHeight} + int{hasIntrinsics} > 1)
    object.fail("", "has several projections", "one of verticalFovDegrees, orthographicHeight and intrinsics");
  if (!hasFov && !hasHeight && !hasIntrinsics) return;
  camera.pixelAspect = 1;
  camera.middleX = camera.middleY = 0;
  camera.orthographicHeight = 0;
  if (hasFov) camera.verticalFovDegrees = object.number("verticalFovDegrees", 1e-3, 179);
  if (hasHeight) camera.orthographicHeight = object.number("orthographicHeight", 1e-12, bake::kMaxSceneLength);
  if (!hasIntrinsics) return;
  StrictObject intrinsics = object.object("intrinsics");
  bake::Intrinsics values;
  bake::visitIntrinsicsKeys(bake::KeyReader(intrinsics), values);
  intrinsics.finish();
  bake::setIntrinsics(values, width, height, where, camera);
}

}  // namespace

pack::Camera readCamera(StrictObject object, const pack::Scene& scene, double width, double height,
                        const std::string& where) {
  pack::Camera camera = scene.camera;
  readPlace(object, scene, where, camera);
  readProjection(object, width, height, where, camera);
  object.finish();
  return camera;
}

pack::Camera parseCamera(const std::string& text, const pack::Scene& scene, double width, double height,
                         const std::string& where) {
  const nlohmann::json keys = nlohmann::json::parse(text, nullptr, false);
  if (!keys.is_object())
    throw Error(where, "is not a JSON object", R"({"position": [0, 1, 4], "target": [0, 0, 0]})", text);
  return readCamera(StrictObject(keys, where, ""), scene, width, height, where);
}

}  // namespace malus::render
