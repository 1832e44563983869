#include "render/embree/ray_replay.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>
#include <oneapi/tbb/task_arena.h>

namespace malus::embree {

namespace {

constexpr std::size_t kChunk = 4096;

struct Counts {
  std::uint64_t hits = 0, checksum = 0;

  void add(unsigned mesh, unsigned triangle) {
    if (mesh == Intersection::kMiss) return;
    ++hits;
    checksum += (std::uint64_t{mesh} << 32 | triangle) * 0x9e3779b97f4a7c15u;  // Fibonacci hashing: Knuth, vol. 3, 6.4
  }
};

// Copies up to N rays from `first` on and returns which are valid. The others keep what an earlier packet left.
template <std::size_t N, class Ray>
void load(const RayArrays& rays, std::size_t first, std::size_t count, Ray& packet, int* valid) {
  std::copy_n(rays.origin[0].data() + first, count, packet.org_x);
  std::copy_n(rays.origin[1].data() + first, count, packet.org_y);
  std::copy_n(rays.origin[2].data() + first, count, packet.org_z);
  std::copy_n(rays.direction[0].data() + first, count, packet.dir_x);
  std::copy_n(rays.direction[1].data() + first, count, packet.dir_y);
  std::copy_n(rays.direction[2].data() + first, count, packet.dir_z);
  for (std::size_t i = 0; i < N; ++i) valid[i] = i < count ? -1 : 0;
}

template <std::size_t N>
Counts replayNearest(const Bvh& bvh, const RayArrays& rays, std::size_t begin, std::size_t end, bool coherent) {
  Counts counts;
  RayHitPacket<N> query{};
  alignas(64) int valid[N];
  initializeRay(query.ray);
  for (std::size_t i = begin; i < end; i += N) {
    const std::size_t count = std::min(N, end - i);
    load<N>(rays, i, count, query.ray, valid);
    initializeHit(query);
    bvh.nearest(valid, query, coherent);
    for (std::size_t k = 0; k < count; ++k)
      counts.add(bvh.hitMesh(query.hit.geomID[k], query.hit.instID[0][k]), query.hit.primID[k]);
  }
  return counts;
}

template <std::size_t N>
Counts replayShadows(const Bvh& bvh, const RayArrays& rays, std::size_t begin, std::size_t end, bool coherent) {
  Counts counts;
  RayPacket<N> query{};
  alignas(64) int valid[N];
  initializeRay(query);
  for (std::size_t i = begin; i < end; i += N) {
    const std::size_t count = std::min(N, end - i);
    load<N>(rays, i, count, query, valid);
    setField(query.tfar, 1.0f);
    bvh.occluded(valid, query, coherent);
    for (std::size_t k = 0; k < count; ++k) counts.hits += query.tfar[k] < 0;
  }
  return counts;
}

template <>
Counts replayNearest<1>(const Bvh& bvh, const RayArrays& rays, std::size_t begin, std::size_t end, bool) {
  Counts counts;
  const auto& [o, d] = rays;
  for (std::size_t i = begin; i < end; ++i) {
    const Intersection at = bvh.nearest({o[0][i], o[1][i], o[2][i]}, {d[0][i], d[1][i], d[2][i]});
    counts.add(at.mesh, at.triangle);
  }
  return counts;
}

template <>
Counts replayShadows<1>(const Bvh& bvh, const RayArrays& rays, std::size_t begin, std::size_t end, bool) {
  Counts counts;
  const auto& [o, d] = rays;
  for (std::size_t i = begin; i < end; ++i)
    counts.hits += !bvh.visible({o[0][i], o[1][i], o[2][i]}, {d[0][i], d[1][i], d[2][i]}, 1);
  return counts;
}

using ReplayChunk = Counts (*)(const Bvh&, const RayArrays&, std::size_t, std::size_t, bool);

ReplayChunk chunkFunction(unsigned width, bool shadow) {
  switch (width) {
    case 4:
      return shadow ? replayShadows<4> : replayNearest<4>;
    case 8:
      return shadow ? replayShadows<8> : replayNearest<8>;
    case 16:
      return shadow ? replayShadows<16> : replayNearest<16>;
    default:
      return shadow ? replayShadows<1> : replayNearest<1>;
  }
}

// Spreads the lowest 10 bits of x to every third bit.
std::uint32_t spreadBits(std::uint32_t x) {
  std::uint32_t spread = 0;
  for (int bit = 0; bit < 10; ++bit) spread |= (x >> bit & 1u) << (3 * bit);
  return spread;
}

}  // namespace

std::string RayCall::name() const {
  const char* hint = width == 1 ? "" : coherent ? " coherent" : " incoherent";
  return fmt::format("{}{}{}", width, hint, sorted ? ", sorted" : "");
}

std::vector<RayCall> rayCalls(const Bvh& bvh) {
  std::vector<RayCall> calls;
  for (const unsigned width : {1u, 4u, 8u, 16u})
    if (bvh.isNative(width))
      for (const bool sorted : {false, true})
        for (const bool coherent : {false, true})
          if (width > 1 || !coherent) calls.push_back({width, coherent, sorted});
  return calls;
}

RayArrays sortRays(const RayArrays& rays) {
  std::array<float, 3> low{}, scale{};
  for (std::size_t axis = 0; axis < 3 && rays.size() > 0; ++axis) {
    const auto [least, most] = std::ranges::minmax(rays.origin[axis]);
    low[axis] = least;
    scale[axis] = most > least ? 1023 / (most - least) : 0;
  }
  std::vector<std::pair<std::uint64_t, std::size_t>> order(rays.size());  // key and index: a total order
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float cell = std::clamp((rays.origin[axis][i] - low[axis]) * scale[axis], 0.0f, 1023.0f);
      key |= std::uint64_t{spreadBits(static_cast<std::uint32_t>(cell))} << axis;
    }
    key |= std::uint64_t{octant(glm::vec3(rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]))} << 32;
    order[i] = {key, i};
  });
  tbb::parallel_sort(order);
  RayArrays sorted;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sorted.origin[axis].reserve(rays.size());
    sorted.direction[axis].reserve(rays.size());
    for (const auto& [key, i] : order) {
      sorted.origin[axis].push_back(rays.origin[axis][i]);
      sorted.direction[axis].push_back(rays.direction[axis][i]);
    }
  }
  return sorted;
}

ReplayResult replay(const Bvh& bvh, const RayArrays& rays, bool shadow, const RayCall& call, int threads) {
  const ReplayChunk replayChunk = chunkFunction(call.width, shadow);
  const std::size_t chunks = (rays.size() + kChunk - 1) / kChunk;
  std::atomic<std::uint64_t> hits{0}, checksum{0};
  tbb::task_arena arena(threads);
  ReplayResult result;
  arena.execute([&] {
    const auto start = std::chrono::steady_clock::now();
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t i) {
      const Counts counts = replayChunk(bvh, rays, i * kChunk, std::min((i + 1) * kChunk, rays.size()), call.coherent);
      hits += counts.hits;
      checksum += counts.checksum;
    });
    result.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  });
  result.hits = hits;
  result.checksum = checksum;
  return result;
}

}  // namespace malus::embree
