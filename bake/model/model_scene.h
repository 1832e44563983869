// A scene from a model file alone: the rules by which a file without scene.json gets a camera, light, a size, a depth
// and an exposure. bake/SCENE.md ("A model without scene.json") states them for users.
//
// describeModel() makes the description, with an import of the whole file; bake() reads the file once and calls
// completeModel() with its contents; the baker of files sets depth and exposure by the depth probe. The completed
// description can be written as scene.json (bake/scene_file/write_scene_file.h) and gives the same pack.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/depth_probe.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/read/source_view.h"

namespace malus::bake {

// The longer side of the image; with the framing camera, and with a camera without an aspect, it has the ratio 4 : 3.
inline constexpr std::uint32_t kModelPixels = 1280;
inline constexpr double kModelAspect = 4.0 / 3;

// The depth is the least that keeps all but this share of the light (bake/depth_probe.h), within these bounds. The
// share is a tenth of the one that is reported, because the light that is lost may be that of one small part of the
// image.
inline constexpr double kModelLostLight = kLostLight / 10;
inline constexpr std::uint32_t kLeastModelDepth = 2, kMostModelDepth = 12;
inline constexpr std::uint32_t kUnmeasuredDepth = 8;  // without a depth probe

// Corners of a part that are closer than this share of its box become one vertex: exporters round the two sides of a
// seam differently.
inline constexpr double kModelWeldRelative = 1e-6;

// Value of --camera for the framing camera of a file that has cameras.
inline constexpr const char* kFramingCamera = "frame";

struct ModelOptions {
  std::string camera;                 // name or number of a camera of the file, or kFramingCamera; empty: the first
  std::filesystem::path environment;  // latitude-longitude image in place of the studio; empty: none
};

// Whether the name has the extension of a model file: .gltf, .glb, .obj, .ply, .stl or .off, in any case.
bool isModelFile(const std::filesystem::path& file);

// The file is not read. The scene is named after it.
SceneDescription describeModel(const std::filesystem::path& file, const ModelOptions& options);

// Cameras, lights and box of a model file, in world space.
struct ModelContents {
  std::vector<prep::SourceCamera> cameras;
  std::vector<prep::SourceLight> lights;
  glm::dvec3 low{0.0}, high{0.0};  // box of the meshes
};

// Sets camera, size, lights and environment of a description that describeModel() made. Adds notes about content that
// is left out, and to choices what was chosen by which rule, a line each. Throws Error: a camera that does not exist or
// that a scene cannot have, a box out of range.
void completeModel(SceneDescription& description, const ModelContents& contents, std::vector<std::string>& notes,
                   std::vector<std::string>& choices);

// Sets the depth, and unless the studio is the only light the exposure, in the description and the scene. Call it
// before applyProbe().
void applyModelProbe(const DepthProbe& probe, SceneDescription& description, pack::Scene& scene,
                     std::vector<std::string>& choices);

// Exposure in stops, a multiple of 1/2, at which the radiance that 95 % of the lit pixels do not exceed is displayed at
// about 0.8 of white. 0 if no pixel is lit.
double measuredExposure(std::vector<double> pixelRadiance);

}  // namespace malus::bake
