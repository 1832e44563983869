#include "render/reference/queries.h"

#include <algorithm>

namespace malus::reference {

namespace {

constexpr std::size_t kLanes = 16;
// Closer to an edge, in barycentric coordinates, several triangles may be the nearest; which one is found must not
// depend on the other rays.
constexpr float kNearEdge = 1e-5f;

void setRay(RTCRay16& packet, std::size_t lane, const glm::vec3& origin, const glm::vec3& direction) {
  packet.org_x[lane] = origin.x, packet.org_y[lane] = origin.y, packet.org_z[lane] = origin.z;
  packet.dir_x[lane] = direction.x, packet.dir_y[lane] = direction.y, packet.dir_z[lane] = direction.z;
}

// The first `count` lanes.
void setValid(int* valid, std::size_t count) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) valid[lane] = lane < count ? -1 : 0;
}

// Calls trace(first, count) for the rays of each packet, in their order: Embree itself divides a packet by octants, and
// an incoherent call soon follows each ray alone.
template <class Trace>
void forEachPacket(std::size_t rays, Trace trace) {
  for (std::size_t first = 0; first < rays; first += kLanes) trace(first, std::min(kLanes, rays - first));
}

}  // namespace

void findNearest(const embree::Bvh& bvh, std::span<const Ray> rays, std::vector<embree::Intersection>& found) {
  found.resize(rays.size());
  RTCRayHit16 query;
  embree::initializeRay(query.ray);
  forEachPacket(rays.size(), [&](std::size_t first, std::size_t count) {
    alignas(64) int valid[kLanes];
    setValid(valid, count);
    embree::initializeHit(query);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Ray& ray = rays[first + lane];
      setRay(query.ray, lane, ray.queryOrigin, glm::vec3(ray.d));
    }
    // By an incoherent call: where two surfaces nearly coincide, coherent ones find another triangle than single rays.
    bvh.nearest(valid, query, false);
    for (std::size_t lane = 0; lane < count; ++lane) {
      embree::Intersection& hit = found[first + lane];
      hit = {bvh.hitMesh(query.hit.geomID[lane], query.hit.instID[0][lane]), query.hit.primID[lane], query.hit.u[lane],
             query.hit.v[lane]};
      if (hit.mesh == embree::Intersection::kMiss || std::min({hit.b1, hit.b2, 1 - hit.b1 - hit.b2}) > kNearEdge)
        continue;
      const Ray& ray = rays[first + lane];
      hit = bvh.nearest(ray.queryOrigin, glm::vec3(ray.d));
    }
  });
}

void findVisible(const embree::Bvh& bvh, std::span<const ShadowRay> rays, std::vector<std::uint8_t>& visible) {
  visible.resize(rays.size());
  RTCRay16 query;
  embree::initializeRay(query);
  forEachPacket(rays.size(), [&](std::size_t first, std::size_t count) {
    alignas(64) int valid[kLanes];
    setValid(valid, count);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const ShadowRay& ray = rays[first + lane];
      setRay(query, lane, ray.origin, ray.direction);
      query.tfar[lane] = ray.length;
    }
    bvh.occluded(valid, query, false);
    for (std::size_t lane = 0; lane < count; ++lane) visible[first + lane] = query.tfar[lane] >= 0 ? 1 : 0;
  });
}

}  // namespace malus::reference
