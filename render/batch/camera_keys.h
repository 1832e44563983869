// The key `camera` of a frame.
#pragma once

#include <string>

#include "bake/pack/scene.h"
#include "bake/scene_file/strict_object.h"

namespace malus::render {

// Returns the scene's camera with the keys of the object in place of its pose and its projection:
//   position, target, up        metres in world space; up (0, 1, 0) by default
//   pose                        in their place: 3 or 4 rows of 4 numbers, from camera axes (x right, y up, z toward the
//                               viewer) to world space
//   verticalFovDegrees, orthographicHeight or intrinsics {fx, fy, cx, cy}
// width, height: of the frame, in pixels. where: "FILE:LINE". Throws Error: a pose that is not a rigid motion, keys
// that exclude each other.
pack::Camera readCamera(bake::StrictObject object, const pack::Scene& scene, double width, double height,
                        const std::string& where);

// The same of a JSON text: the value of --view, or a camera that `malus view` prints. where: for errors.
pack::Camera parseCamera(const std::string& text, const pack::Scene& scene, double width, double height,
                         const std::string& where);

}  // namespace malus::render
