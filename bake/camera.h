// The camera of a scene from its description: a position and a direction, and intrinsics in pixels.
#pragma once

#include <string_view>

#include <glm/vec3.hpp>

#include "bake/pack/scene.h"
#include "bake/scene_file/scene_file.h"

namespace malus::bake {

// Sets position and axes. position, target: in the coordinates of the camera's position. where: the file, for errors.
// Throws Error if the target is the position or up is parallel to the view.
void placeCamera(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up, std::string_view where,
                 pack::Camera& camera);

// Sets the field of view, the aspect of the pixels and the middle of an image of width x height pixels: a pixel (x, y)
// sees the direction ((x - cx) / fx, (cy - y) / fy, 1) along right, up and forward. Throws Error out of range.
void setIntrinsics(const Intrinsics& intrinsics, double width, double height, std::string_view where,
                   pack::Camera& camera);

}  // namespace malus::bake
