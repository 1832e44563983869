// The light that arrives along rays, by recursion: a batch of rays is traced together, then the rays that leave its
// hits, and so on; then the light of the batch follows from the light that arrived. Each level is held only once per
// batch, so that memory grows with the depth and not with the number of paths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/reference/hit.h"
#include "render/reference/lights.h"
#include "render/reference/queries.h"
#include "render/scene/fault.h"
#include "render/scene/render_parameters.h"

namespace malus::reference {

// Most rays of a batch.
inline constexpr std::size_t kBatch = 256;

class Tracer {
 public:
  std::uint64_t rays = 0;  // traced so far
  render::Faults faults;

  Tracer(const SceneAccess& access, const render::RenderParameters& parameters);

  // Light that arrives along -d of each ray, in the canonical frame of the ray, as basic radiance. depth: specular
  // interactions left.
  void trace(std::span<const Ray> batch, std::uint32_t depth, std::span<Light> light);

 private:
  enum class Step : std::uint8_t { environment, emitter, diffuse, element, nothing, interface, facets };

  // A facet of a rough surface that reflects light toward the camera.
  struct Facet {
    dvec3 mirror, s;
    double c, weight;
  };

  // A ray with its hit. Its arrivals and children are ranges in the level.
  struct Node {
    Step step;
    std::uint32_t firstArrival, arrivals, firstChild, firstFacet, facets;
    Hit hit;
    Refraction refraction;
    dvec3 mirror, s;         // s: the s direction, the same for all three rays
    FrameRotation rotation;  // of the ray, to the frame of the surface
  };

  // Memory of a batch, by the depth of its rays.
  struct Level {
    std::vector<embree::Intersection> found;
    std::vector<Node> nodes;  // per ray
    std::vector<Arrival> arrivals;
    std::vector<ShadowRay> ways;  // per arrival
    std::vector<std::uint8_t> visible;
    std::vector<WayFilter> filters;  // per arrival, or empty
    std::vector<Facet> facets;
    std::vector<Ray> children;
    std::vector<Light> arrived;  // per child
  };

  void traceBatch(std::span<const Ray> batch, std::uint32_t depth, std::span<Light> light);
  static void addChild(const Ray& ray, const Hit& h, const dvec3& direction, const dvec3& queryOrigin,
                       std::uint32_t path, Level& level);
  void begin(const Ray& ray, const embree::Intersection& found, std::uint32_t depth, Level& level, Node& node) const;
  void beginInterface(const Ray& ray, std::uint32_t depth, Level& level, Node& node) const;
  void beginFacets(const Ray& ray, Level& level, Node& node) const;
  void addArrivals(const Ray& ray, std::uint32_t depth, const dvec3& mirror, Level& level, Node& node) const;

  Light finish(const Ray& ray, std::uint32_t depth, const Level& level, const Node& node);
  Light finishInterface(const Ray& ray, std::uint32_t depth, const Level& level, const Node& node);
  Light facetLight(const Level& level, const Node& node, Light& arrivedPart) const;
  DirectLight sumDirectLight(const Level& level, const Node& node) const;

  Light checked(const Ray& ray, const Hit& h, std::uint32_t depth, const Light& sent, std::span<const Light> arriving);

  const SceneAccess& access_;
  const render::RenderParameters& parameters_;
  std::vector<Level> levels_;
};

}  // namespace malus::reference
