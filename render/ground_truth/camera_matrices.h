// The camera of an image as matrices, for readers of its files.
#pragma once

#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

// From the axes of the camera (x right, y up, z toward the viewer) to world space, for column vectors; and its inverse.
glm::dmat4 cameraToWorld(const pack::Scene& scene);
glm::dmat4 worldToCamera(const pack::Scene& scene);

// The focal lengths and the principal point of a perspective camera, in pixels of an image of width x height pixels,
// from its upper left corner: a point (x, y, z) in the axes of the camera is at (cx + fx x / -z, cy - fy y / -z). The
// centre of the first pixel is at (0.5, 0.5).
struct PixelIntrinsics {
  double fx, fy, cx, cy;
};
PixelIntrinsics pixelIntrinsics(const pack::Camera& camera, double width, double height);

// {"type": "perspective" or "orthographic", "width", "height", "cameraToWorld", "worldToCamera": lists of four rows,
// "intrinsics": {"fx", "fy", "cx", "cy"} or null, "matrix": 3 x 3 of the intrinsics (x right, y down, z forward) or
// null, "orthographicHeight": in metres or null, "pixelsPerMetre": {"x", "y"} of an orthographic camera or null,
// "principalPoint": its pixel on the axis or null, "convention": text}.
nlohmann::json cameraJson(const pack::Scene& scene, const RenderParameters& parameters);

// The attribute worldToCamera of EXR files, which multiplies row vectors.
std::vector<float> exrWorldToCamera(const pack::Scene& scene);
// "X Y WIDTH HEIGHT of IMAGEWIDTH IMAGEHEIGHT"
std::string regionText(const RenderParameters& parameters);

}  // namespace malus::render
