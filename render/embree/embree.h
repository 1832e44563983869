// Embree 3 (Debian 12) and Embree 4 (Debian 13) behind one interface: a device, a scene of triangle meshes and two
// queries. Meshes of origin 0 are in the scene itself, others in an instance per origin, and a mesh that is placed
// several times in another scene with an instance per place. The scenes are built with RTC_SCENE_FLAG_ROBUST:
// without it, rays leak through shared edges.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "render/embree/cut_out.h"
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
// End of a ray that nothing ends, in lengths of its direction.
inline constexpr float kFarthest = 1e30f;

// A field of a single ray, or that of all rays of a packet.
template <class Value>
void setField(Value& field, Value value) {
  field = value;
}
template <class Value, std::size_t N>
void setField(Value (&field)[N], Value value) {
  std::fill_n(field, N, value);
}

// Sets the fields that all queries have in common. No call of Embree changes them.
template <class Ray>
void initializeRay(Ray& ray) {
  setField(ray.tnear, kNearest);
  setField(ray.time, 0.0f);
  setField(ray.mask, ~0u);
  setField(ray.id, 0u);
  setField(ray.flags, 0u);
}

// The start of a query for the nearest triangle: no hit at any distance.
template <class RayHit>
void initializeHit(RayHit& query) {
  setField(query.ray.tfar, kFarthest);
  setField(query.hit.geomID, Intersection::kMiss);
  setField(query.hit.instID[0], Intersection::kMiss);
}

// Bit i is set where the direction is negative along axis i. Packets whose rays are in one octant are traced fastest.
template <class Direction>
std::uint32_t octant(const Direction& d) {
  return (d.x < 0 ? 1u : 0u) | (d.y < 0 ? 2u : 0u) | (d.z < 0 ? 4u : 0u);
}
inline constexpr std::uint32_t kOctants = 8;

class Bvh {
 public:
  // threads: 0 for all. Throws Error if Embree reports an error.
  Bvh(const render::RenderScene& scene, unsigned threads);
  ~Bvh();
  Bvh(const Bvh&) = delete;
  Bvh& operator=(const Bvh&) = delete;

  // kInstances: false if the caller knows that the scene has no instances.
  template <bool kInstances = true>
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

  // The mesh of a hit of a packet, from its hit.geomID and hit.instID[0]; kMiss of a ray that meets nothing. Without
  // instances it is the former.
  unsigned hitMesh(unsigned geometry, unsigned instance) const { return geometry + firstMeshes_[instance + 1]; }
  bool hasInstances() const { return hasInstances_; }
  const std::uint32_t* firstMeshes() const { return firstMeshes_.data(); }

  // Geometries of all scenes, and instances: of runs of meshes and of places.
  struct Counts {
    std::size_t geometries = 0, instances = 0;
  };
  const Counts& counts() const { return counts_; }

  // Whether packets of a width are traced as such on this processor; others are split.
  bool isNative(unsigned width) const;

  static std::string version();  // "Embree 3.13.5"

 private:
  RTCScene newScene();
  void attachMeshes(RTCScene to, const render::RenderScene& scene, const render::MeshRun& run, unsigned firstId);
  void attachInstance(RTCScene instanced, const render::RenderScene& scene, const render::MeshRun& run);

  std::vector<std::unique_ptr<const CutOut>> cutOuts_;  // that filter functions read
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::vector<std::uint32_t> firstMeshes_{0};  // by 1 + instance: what is added to the geometry
  bool hasInstances_ = false;
  Counts counts_;
};

template <bool kInstances>
Intersection Bvh::nearest(const glm::vec3& o, const glm::vec3& d) const {
  RTCRayHit query;
  query.ray.org_x = o.x, query.ray.org_y = o.y, query.ray.org_z = o.z;
  query.ray.dir_x = d.x, query.ray.dir_y = d.y, query.ray.dir_z = d.z;
  initializeRay(query.ray);
  initializeHit(query);
  query.hit.primID = 0;  // read also where nothing is hit
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene_, &query, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_, &context, &query);
#endif
  const unsigned mesh = kInstances ? hitMesh(query.hit.geomID, query.hit.instID[0]) : query.hit.geomID;
  return {mesh, query.hit.primID, query.hit.u, query.hit.v};
}

inline bool Bvh::visible(const glm::vec3& o, const glm::vec3& d, float distance) const {
  RTCRay ray;
  ray.org_x = o.x, ray.org_y = o.y, ray.org_z = o.z;
  ray.dir_x = d.x, ray.dir_y = d.y, ray.dir_z = d.z;
  initializeRay(ray);
  ray.tfar = distance;
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
