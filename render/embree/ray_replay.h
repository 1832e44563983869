// Traces recorded rays again by each call of Embree, and nothing else: the floor of a renderer that traces them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/embree/embree.h"
#include "render/embree/ray_log.h"

namespace malus::embree {

// A call of Embree, and the order in which it gets the rays.
struct RayCall {
  unsigned width = 1;     // rays: 1, 4, 8 or 16
  bool coherent = false;  // the hint for packets
  bool sorted = false;    // by direction and origin, else as they were traced

  std::string name() const;  // "16 coherent, sorted"
};

// Every call with packets that this processor traces as such.
std::vector<RayCall> rayCalls(const Bvh& bvh);

// The rays in an order in which neighbours are similar: by octant of the direction, and within it along a Morton curve
// of the origins (Morton 1966), 10 bits along each axis of their box. Deterministic.
RayArrays sortRays(const RayArrays& rays);

struct ReplayResult {
  double ms = 0;
  std::uint64_t hits = 0;      // rays that met a triangle; of shadow rays: those that are blocked
  std::uint64_t checksum = 0;  // sum over the hits of a mix of mesh and triangle; 0 for shadow rays
};

// Traces rays in chunks of 4096 on `threads` threads. rays: in the order of the call.
ReplayResult replay(const Bvh& bvh, const RayArrays& rays, bool shadow, const RayCall& call, int threads);

}  // namespace malus::embree
