// Queries of many rays at once: Embree's packets of rays that point into the same octant.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/reference/hit.h"

namespace malus::reference {

// The way from a hit to a light.
struct ShadowRay {
  glm::vec3 origin, direction;  // direction: unit
  float length;
};

class Queries {
 public:
  explicit Queries(const embree::Bvh& bvh) : bvh_(bvh) {}

  // The nearest triangles.
  void findNearest(std::span<const Ray> rays, std::vector<embree::Intersection>& found);
  // 1 for each way that no surface blocks, else 0.
  void findVisible(std::span<const ShadowRay> rays, std::vector<std::uint8_t>& visible);

 private:
  template <class Direction>
  void sortByOctant(std::size_t count, Direction direction);
  template <class Trace>
  void forEachPacket(Trace trace);

  const embree::Bvh& bvh_;
  std::vector<std::uint32_t> octants_;
  std::vector<std::uint32_t> order_;
  std::uint32_t ends_[embree::kOctants] = {};  // of the octants in order_
};

}  // namespace malus::reference
