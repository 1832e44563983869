#include "render/reference/queries.h"

#include <algorithm>

#include "render/embree/counting_sort.h"

namespace malus::reference {

namespace {

constexpr std::size_t kLanes = 16;
// Fewer rays are faster one by one.
constexpr std::size_t kFewRays = 3;
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

}  // namespace

template <class Direction>
void Queries::sortByOctant(std::size_t count, Direction direction) {
  octants_.resize(count);
  order_.resize(count);
  for (std::size_t i = 0; i < count; ++i) octants_[i] = embree::octant(direction(i));
  embree::countingSort(octants_.data(), static_cast<std::uint32_t>(count), ends_, order_.data());
}

template <class Trace>
void Queries::forEachPacket(Trace trace) {
  std::size_t begin = 0;
  for (const std::uint32_t end : ends_)
    for (; begin < end; begin = std::min<std::size_t>(begin + kLanes, end))
      trace(std::span(order_).subspan(begin, std::min<std::size_t>(kLanes, end - begin)));
}

void Queries::findNearest(std::span<const Ray> rays, std::vector<embree::Intersection>& found) {
  found.resize(rays.size());
  sortByOctant(rays.size(), [&](std::size_t i) { return rays[i].d; });
  forEachPacket([&](std::span<const std::uint32_t> packet) {
    if (packet.size() < kFewRays) {
      for (const std::uint32_t i : packet) found[i] = bvh_.nearest(rays[i].queryOrigin, glm::vec3(rays[i].d));
      return;
    }
    alignas(64) int valid[kLanes];
    setValid(valid, packet.size());
    RTCRayHit16 query;
    embree::initializeRay(query.ray);
    embree::initializeHit(query);
    for (std::size_t lane = 0; lane < packet.size(); ++lane) {
      const Ray& ray = rays[packet[lane]];
      setRay(query.ray, lane, ray.queryOrigin, glm::vec3(ray.d));
    }
    // By an incoherent call: where two surfaces nearly coincide, coherent ones find another triangle than single rays.
    bvh_.nearest(valid, query, false);
    for (std::size_t lane = 0; lane < packet.size(); ++lane) {
      embree::Intersection& hit = found[packet[lane]];
      hit = {bvh_.hitMesh(query.hit.geomID[lane], query.hit.instID[0][lane]), query.hit.primID[lane], query.hit.u[lane],
             query.hit.v[lane]};
      if (hit.mesh == embree::Intersection::kMiss || std::min({hit.b1, hit.b2, 1 - hit.b1 - hit.b2}) > kNearEdge)
        continue;
      const Ray& ray = rays[packet[lane]];
      hit = bvh_.nearest(ray.queryOrigin, glm::vec3(ray.d));
    }
  });
}

void Queries::findVisible(std::span<const ShadowRay> rays, std::vector<std::uint8_t>& visible) {
  visible.resize(rays.size());
  sortByOctant(rays.size(), [&](std::size_t i) { return rays[i].direction; });
  forEachPacket([&](std::span<const std::uint32_t> packet) {
    if (packet.size() < kFewRays) {
      for (const std::uint32_t i : packet)
        visible[i] = bvh_.visible(rays[i].origin, rays[i].direction, rays[i].length) ? 1 : 0;
      return;
    }
    alignas(64) int valid[kLanes];
    setValid(valid, packet.size());
    RTCRay16 query;
    embree::initializeRay(query);
    for (std::size_t lane = 0; lane < packet.size(); ++lane) {
      const ShadowRay& ray = rays[packet[lane]];
      setRay(query, lane, ray.origin, ray.direction);
      query.tfar[lane] = ray.length;
    }
    bvh_.occluded(valid, query, false);
    for (std::size_t lane = 0; lane < packet.size(); ++lane) visible[packet[lane]] = query.tfar[lane] >= 0 ? 1 : 0;
  });
}

}  // namespace malus::reference
