// Rays of the reference, and the points where they meet surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "bake/pack/scene.h"
#include "render/embree/embree.h"
#include "render/reference/surface.h"
#include "render/scene/area_lights.h"

namespace malus::reference {

// Unit normal of a triangle, from outside, and twice its area; without area the normal is 0. longest: a bound on the
// length of its edges.
struct Face {
  dvec3 normal;
  double area2, longest;
};
std::vector<Face> computeFaces(const pack::Mesh& mesh);

// Meshes and places of bvh, as of render::RenderScene.
struct MeshRecords {
  std::vector<std::uint32_t> meshes, instances;
  std::vector<gpu::MeshTransform> transforms;
};

// Data that every thread reads.
struct SceneAccess {
  const pack::Scene& scene;
  const embree::Bvh& bvh;
  const MeshRecords& records;
  const std::vector<std::vector<Face>>& faces;        // per triangle of each mesh of scene
  const std::vector<Surface>& surfaces;               // plainSurface() of each material
  const std::vector<dvec3>& hemisphereTransmittance;  // per material
  const std::vector<pack::SpotFalloff>& falloffs;     // per light of scene
  double lightReach;                                  // render::lightReach
  const MeshTextures* textures;                       // null without textures by texture coordinates
  render::CameraCone cone;                            // of the camera's rays
  const render::AreaLights& areaLights;
  const std::vector<float>& environmentDistributions;  // render::environmentDistributions
  std::uint32_t lightSamples = 0;                      // of render::RenderParameters
  bool filtersShadows = false;                         // render::filtersShadows
};

// A ray and its query in single precision, which starts off the surface that the ray leaves.
struct Ray {
  dvec3 origin, d;  // d: unit
  glm::vec3 queryOrigin;
  std::uint32_t pixelX, pixelY;  // in the whole image
  bool isBehindRough;            // the path has met a rough surface; further ones are treated as smooth
  std::uint32_t path;            // shaders/optics/path_word.h
};

// A hit on the triangle that Embree returns, its position recomputed in double precision.
struct Hit {
  dvec3 d, position;
  dvec3 start, error;  // further rays start at `start`, outside the box of this error
  dvec3 above;         // origin of queries that leave on the side of the ray
  dvec3 face;          // unit normal of the face, against the ray
  dvec3 normal;        // unit normal to shade with, against the ray
  double c;            // cosine of the angle of incidence
  bool outside;        // the ray hits the side that the mesh's normals point to
  Surface surface;
  std::uint32_t materialIndex;
  std::uint32_t path;  // path word of the ray; with mesh textures its cone is that at the hit
  double curvature;    // of a smooth mesh, on the side of the ray, with mesh textures
};

// Path words of the rays that leave a hit. facet: its index.
std::uint32_t reflectedPath(const SceneAccess& access, const Hit& h);
std::uint32_t facetPath(const SceneAccess& access, const Hit& h, std::uint32_t facet);
inline std::uint32_t transmittedPath(const Hit& h) { return f64::transmittedPath(h.path); }

// The material of a hit, and the hit. found: a hit of Embree, not a miss.
inline const pack::Material& findMaterial(const SceneAccess& access, const embree::Intersection& found) {
  return access.scene.materials[access.scene.meshes[access.records.meshes[found.mesh]].material];
}
void findHit(const SceneAccess& access, const Ray& ray, const embree::Intersection& found, Hit& hit);

// In place of a hit where a ray leaves the scene.
Hit environmentHit(const dvec3& d);

// Origin of queries that leave on the other side.
inline dvec3 queryBelow(const Hit& h) { return f64::rayOrigin(h.start, h.error, -h.face, 0x1p-24); }

// Indices on this side and beyond, and the transmitted ray.
struct Refraction {
  double n1, n2;
  dvec3 direction;
  bool isTotal;
};
// Replaces a shading normal by that of the face if the ray would not pass the face.
Refraction refractionAt(Hit& h);

// Absorption of the medium on the side of the ray, in 1/m.
inline const dvec3& absorptionAt(const Hit& h) {
  const pack::Material& m = *h.surface.material;
  return pack::hasInside(m.kind) && !h.outside ? m.absorption : m.outsideAbsorption;
}
// Transmittance of that medium from the ray's origin to the hit.
inline dvec3 mediumTransmittance(const Ray& ray, const Hit& h) {
  const dvec3& absorption = absorptionAt(h);
  return absorption == dvec3(0) ? dvec3(1) : transmittanceOver(absorption, glm::length(h.position - ray.origin));
}

}  // namespace malus::reference
