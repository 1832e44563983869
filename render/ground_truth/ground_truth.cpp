#include "render/ground_truth/ground_truth.h"

#include <cmath>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <glm/geometric.hpp>

#include "render/reference/camera_rays.h"
#include "render/reference/scene_data.h"

namespace malus::render {

namespace {

using reference::Hit;
using reference::Ray;
using reference::SceneAccess;

bool endsPath(const Hit& hit) {
  return !pack::isInterface(hit.surface.material->kind) || hit.surface.albedo != glm::dvec3(0.0);
}

// Finds the nearest hit. mesh: that of the renderers.
bool findNearest(const SceneAccess& access, const Ray& ray, Hit& hit, std::uint32_t& mesh) {
  const embree::Intersection found = access.bvh.nearest(ray.queryOrigin, glm::vec3(ray.d));
  if (found.mesh == embree::Intersection::kMiss) return false;
  reference::findHit(access, ray, found, hit);
  mesh = found.mesh;
  return true;
}

// The ray that continues the principal path.
Ray continued(const SceneAccess& access, const Ray& ray, Hit& hit) {
  const pack::MaterialKind kind = hit.surface.material->kind;
  const auto passing = [&](const glm::dvec3& direction) {
    return Ray{hit.position, direction,         glm::vec3(reference::queryBelow(hit)), ray.pixelX,
               ray.pixelY,   ray.isBehindRough, reference::transmittedPath(hit)};
  };
  if (pack::isPolarizingElement(kind)) return passing(hit.d);
  const reference::Refraction refraction = reference::refractionAt(hit);
  if (pack::isClear(kind) && !refraction.isTotal) return passing(refraction.direction);
  return {
      hit.position,      f64::mirrorDirection(hit.d, hit.normal, hit.c), glm::vec3(hit.above), ray.pixelX, ray.pixelY,
      ray.isBehindRough, reference::reflectedPath(access, hit)};
}

std::uint32_t countInteractions(const SceneAccess& access, Ray ray, Hit hit, std::uint32_t depth) {
  std::uint32_t count = 1, mesh = 0;
  while (count <= depth && !endsPath(hit)) {
    ray = continued(access, ray, hit);
    if (!findNearest(access, ray, hit, mesh)) break;
    ++count;
  }
  return count;
}

PixelTruth findTruth(const SceneAccess& access, const Ray& ray, std::uint32_t depth) {
  PixelTruth truth;
  Hit hit{};
  std::uint32_t mesh = 0;
  if (!findNearest(access, ray, hit, mesh)) return truth;
  const pack::Scene& scene = access.scene;
  truth.isValid = true;
  truth.material = hit.materialIndex;
  const std::uint32_t instance = access.records.instances[mesh];
  truth.placement = instance == kNoInstance ? access.records.meshes[mesh]
                                            : static_cast<std::uint32_t>(scene.meshes.size()) + instance;
  truth.rayDistance = glm::length(hit.position - ray.origin);
  truth.depth = glm::dot(hit.position - scene.camera.position, scene.camera.forward);
  truth.position = hit.position + scene.origin;
  truth.faceNormal = hit.face;
  truth.shadingNormal = hit.normal;
  truth.incidence = std::acos(hit.c);
  truth.interactions = countInteractions(access, ray, hit, depth);
  return truth;
}

}  // namespace

struct GroundTruth::Impl {
  Impl(const pack::Scene& scene, unsigned threads)
      : data(scene, threads), arena(threads == 0 ? oneapi::tbb::task_arena::automatic : static_cast<int>(threads)) {}
  reference::SceneData data;
  oneapi::tbb::task_arena arena;  // one for every image
};

GroundTruth::GroundTruth(const pack::Scene& scene, unsigned threads) : impl_(std::make_unique<Impl>(scene, threads)) {}

GroundTruth::~GroundTruth() = default;

bool GroundTruth::updateScene() { return impl_->data.update(); }

std::vector<PixelTruth> GroundTruth::render(const RenderParameters& parameters) const {
  const SceneAccess access = impl_->data.access(parameters);
  const reference::CameraRays rays(access.scene.camera, parameters.width, parameters.height);
  const Region& region = parameters.region;
  std::vector<PixelTruth> pixels(std::size_t{region.width} * region.height);
  const auto renderRow = [&](std::uint32_t row) {
    for (std::uint32_t column = 0; column < region.width; ++column) {
      const std::uint32_t x = region.x + column, y = region.y + row;
      const double imageX = (x + 0.5) / parameters.width, imageY = (y + 0.5) / parameters.height;
      const glm::dvec3 origin = rays.origin(imageX, imageY);
      const Ray ray{origin, rays.direction(imageX, imageY), glm::vec3(origin), x, y, false, f64::pathStart(x, y)};
      pixels[std::size_t{row} * region.width + column] = findTruth(access, ray, parameters.depth);
    }
  };
  impl_->arena.execute([&] { oneapi::tbb::parallel_for(0u, region.height, renderRow); });
  return pixels;
}

}  // namespace malus::render
