// The geometry that each pixel of an image sees, without light: from one ray through the centre of the pixel, whatever
// the samples of the image. Rays meet triangles by Embree in single precision; the position on the triangle, and all
// that follows from it, is computed in double precision by the reference renderer.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

// The first surface that a pixel's ray meets. Where it meets none, only `interactions` (0) has a meaning.
struct PixelTruth {
  static constexpr std::uint32_t kNone = 0xffffffff;
  bool isValid = false;
  std::uint32_t material = kNone;   // index into Scene::materials
  std::uint32_t placement = kNone;  // index into pack::placements(): meshes, then instances
  double rayDistance = 0;           // from the ray's origin, metres
  double depth = 0;                 // along the camera's forward axis from the camera's position, metres
  glm::dvec3 position{0.0};         // in world space, metres
  glm::dvec3 faceNormal{0.0};       // unit, of the triangle, against the ray, in world space
  glm::dvec3 shadingNormal{0.0};    // unit, interpolated and mapped, against the ray, in world space
  double incidence = 0;             // angle between the ray and the shading normal, radians
  // Surfaces on the principal path, with the first: it passes clear surfaces (is reflected where reflection is total),
  // is reflected by other interfaces, and ends at an emitter, at a surface with an albedo, in the environment, or after
  // 1 + RenderParameters::depth surfaces.
  std::uint32_t interactions = 0;
};

class GroundTruth {
 public:
  // Builds an acceleration structure. scene must outlive the object. threads: 0 for all cores. Throws Error if Embree
  // fails.
  GroundTruth(const pack::Scene& scene, unsigned threads);
  GroundTruth(pack::Scene&& scene, unsigned threads) = delete;
  ~GroundTruth();
  GroundTruth(const GroundTruth&) = delete;
  GroundTruth& operator=(const GroundTruth&) = delete;

  // As Renderer::updateScene() (render/renderer.h). The camera may change without it.
  bool updateScene();

  // The pixels of parameters.region, rows from the top.
  std::vector<PixelTruth> render(const RenderParameters& parameters) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace malus::render
