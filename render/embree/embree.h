// Embree 3 (Debian 12) and Embree 4 (Debian 13) behind one interface: a device, a scene of triangle meshes and two
// queries. Meshes of origin 0 are in the scene itself, others in an instance per origin. The scene is built with
// RTC_SCENE_FLAG_ROBUST: without it, rays leak through shared edges.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <limits>
#include <string>

#include <glm/vec3.hpp>

#include "render/scene/render_scene.h"

namespace malus::embree {

// Nearest triangle along a ray. mesh: index of the mesh, or kMiss.
struct Intersection {
  static constexpr unsigned kMiss = RTC_INVALID_GEOMETRY_ID;
  unsigned mesh = kMiss;
  unsigned triangle = 0;  // within the mesh
  float b1 = 0, b2 = 0;   // barycentric coordinates of its second and third corner
};

// Packets of N rays, N is 4, 8 or 16, in Embree's structure-of-arrays form.
template <std::size_t N>
struct PacketTypes;
template <>
struct PacketTypes<4> {
  using Ray = RTCRay4;
  using RayHit = RTCRayHit4;
};
template <>
struct PacketTypes<8> {
  using Ray = RTCRay8;
  using RayHit = RTCRayHit8;
};
template <>
struct PacketTypes<16> {
  using Ray = RTCRay16;
  using RayHit = RTCRayHit16;
};
template <std::size_t N>
using RayPacket = typename PacketTypes<N>::Ray;
template <std::size_t N>
using RayHitPacket = typename PacketTypes<N>::RayHit;

// As in Vulkan, a triangle at distance 0 is not hit, so that a camera exactly on a face does not see that face.
inline constexpr float kNearest = std::numeric_limits<float>::min();

class Bvh {
 public:
  // threads: 0 for all. Throws Error if Embree reports an error.
  Bvh(const render::RenderScene& scene, unsigned threads);
  ~Bvh();
  Bvh(const Bvh&) = delete;
  Bvh& operator=(const Bvh&) = delete;

  Intersection nearest(const glm::vec3& origin, const glm::vec3& direction) const;
  // Whether there is no triangle within `distance` lengths of direction, which may have any length but 0.
  bool visible(const glm::vec3& origin, const glm::vec3& direction, float distance) const;

  // The same for packets. valid: -1 for each ray that is traced, else 0. coherent: the rays have similar origins and
  // directions. A ray that meets nothing keeps its hit.geomID; one that is not visible gets a negative tfar.
  void nearest(const int* valid, RTCRayHit4& packet, bool coherent) const;
  void nearest(const int* valid, RTCRayHit8& packet, bool coherent) const;
  void nearest(const int* valid, RTCRayHit16& packet, bool coherent) const;
  void occluded(const int* valid, RTCRay4& packet, bool coherent) const;
  void occluded(const int* valid, RTCRay8& packet, bool coherent) const;
  void occluded(const int* valid, RTCRay16& packet, bool coherent) const;

  // Whether packets of a width are traced as such on this processor; others are split.
  bool isNative(unsigned width) const;

  static std::string version();  // "Embree 3.13.5"

 private:
  RTCScene newScene();
  void attachMeshes(RTCScene to, const render::RenderScene& scene, const render::MeshRun& run);
  void attachInstance(RTCScene instanced, const glm::vec3& origin);

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

inline Intersection Bvh::nearest(const glm::vec3& o, const glm::vec3& d) const {
  RTCRayHit query;
  query.ray.org_x = o.x, query.ray.org_y = o.y, query.ray.org_z = o.z;
  query.ray.dir_x = d.x, query.ray.dir_y = d.y, query.ray.dir_z = d.z;
  query.ray.tnear = kNearest, query.ray.tfar = 1e30f;
  query.ray.time = 0, query.ray.mask = ~0u, query.ray.id = 0, query.ray.flags = 0;
  query.hit.geomID = query.hit.primID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene_, &query, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_, &context, &query);
#endif
  return {query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v};
}

inline bool Bvh::visible(const glm::vec3& o, const glm::vec3& d, float distance) const {
  RTCRay ray;
  ray.org_x = o.x, ray.org_y = o.y, ray.org_z = o.z;
  ray.dir_x = d.x, ray.dir_y = d.y, ray.dir_z = d.z;
  ray.tnear = kNearest, ray.tfar = distance;
  ray.time = 0, ray.mask = ~0u, ray.id = 0, ray.flags = 0;
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene_, &ray, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_, &context, &ray);
#endif
  return ray.tfar >= 0;
}

}  // namespace malus::embree
