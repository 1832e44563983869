// Queries of many rays at once: Embree's packets, whose calls cost less per ray than those of single rays.
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

// Finds the nearest triangles.
void findNearest(const embree::Bvh& bvh, std::span<const Ray> rays, std::vector<embree::Intersection>& found);
// Finds 1 for each way that no surface blocks, else 0.
void findVisible(const embree::Bvh& bvh, std::span<const ShadowRay> rays, std::vector<std::uint8_t>& visible);

}  // namespace malus::reference
