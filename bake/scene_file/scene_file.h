// Reads scene.json (bake/SCENE.md; keys: bake/scene_file/scene_keys.h) into the description that is baked.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/pack/scene.h"
#include "meshprep/prepare.h"

namespace malus::bake {

// Applied in this order.
struct Transform {
  glm::dvec3 scale{1.0};
  glm::dvec3 rotateDegrees{0.0};  // about x, then y, then z
  glm::dvec3 translate{0.0};
};

struct MeshDescription {
  std::string name;
  std::filesystem::path file;  // absolute or relative to the working folder
  std::string material;
  prep::Options preparation;  // without certifyGlass, which depends on the material
  std::vector<Transform> instances;
};

// A whole file: its parts, placed by its instances.
struct ImportDescription {
  std::filesystem::path file;                    // absolute or relative to the working folder
  std::map<std::string, std::string> materials;  // in the file ("": none) to those of the scene
  Transform transform;                           // of all of it
  prep::Options preparation;                     // of every part; open surfaces are listed below
  std::optional<prep::Normals> normals;          // nothing: authored if a part has them, else crease
  std::vector<std::string> openSurfaces;         // names of parts or instances
  bool usesViews = false;                        // cameras and lights of the file are used, not left out
};

// An image of a material: number = offset + scale x value.
struct TextureDescription {
  std::filesystem::path file;
  double scale = 1, offset = 0;
  double low = 0, high = 1;                    // bounds of the numbers
  bool grey = false;                           // the green channel is used for every colour
  bool isColour() const { return high <= 1; }  // an albedo; others are numbers
  friend bool operator==(const TextureDescription&, const TextureDescription&) = default;
};

// Of a pinhole camera, in pixels of the image (bake/SCENE.md).
struct Intrinsics {
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

// The request of a scene that is made of a model file alone (bake/model/model_scene.h).
struct ModelRequest {
  std::string camera;  // as ModelOptions::camera
};

// The name of the environment that is computed (bake/environment/studio.h).
inline constexpr const char* kStudioPreset = "studio";

struct SceneDescription {
  std::filesystem::path file;
  std::string name;
  std::string title;
  std::optional<glm::dvec3> origin;
  glm::dvec3 cameraPosition{0.0};
  glm::dvec3 cameraTarget{0.0};
  glm::dvec3 cameraUp{0.0, 1.0, 0.0};
  double verticalFovDegrees = 40;
  double orthographicHeight = 0;         // metres; 0: perspective
  std::optional<Intrinsics> intrinsics;  // in place of the field of view
  double mediumEta = 1;
  std::uint32_t width = 0, height = 0, depth = 0;
  double exposureEv = 0;
  glm::dvec3 wavelengthsNm = pack::kDefaultWavelengthsNm;
  glm::dvec3 environmentRadiance{0.0};
  std::filesystem::path environmentImage;  // empty: a preset, or constant
  std::string environmentPreset;           // kStudioPreset or empty
  double environmentScale = 1;
  double environmentRotationDegrees = 0;
  double ambientIrradiance = 0;
  bool environmentIlluminates = false;
  glm::dvec3 sun{0.0};  // unit vector toward the sun of a polarized sky; 0: none
  double skyDegree = 0;
  std::vector<TextureDescription> textures;         // indexed by the materials' maps
  std::vector<std::filesystem::path> opticalFiles;  // whose optical constants the materials have
  std::vector<pack::LightSource> lights;            // in world space
  std::vector<pack::Material> materials;
  std::vector<MeshDescription> meshes;
  std::vector<ImportDescription> imports;
  std::vector<std::string> deprecations;  // a line per deprecated key in the file
  std::optional<ModelRequest> model;      // camera, size, lights and environment are completed by bake()
};

// Throws Error: unreadable, not JSON, a key missing, unknown or out of range, an unknown material, nothing to render.
SceneDescription readSceneFile(const std::filesystem::path& path);

}  // namespace malus::bake
