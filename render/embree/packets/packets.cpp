#include "render/embree/packets/packets.h"

#include <algorithm>
#include <numeric>

#include <hwy/targets.h>

namespace malus::embree {

ShadingOrder::ShadingOrder(const render::RenderScene& scene) {
  std::vector<std::uint32_t> materials(scene.materials.size());
  std::iota(materials.begin(), materials.end(), 0u);
  std::ranges::stable_sort(materials, {}, [&](std::uint32_t m) { return scene.materials[m].kind; });
  std::vector<std::uint32_t> bucketOfMaterial(materials.size());
  kindOfBucket.push_back(gpu::kSurfaceKinds);
  for (const std::uint32_t m : materials) {
    bucketOfMaterial[m] = static_cast<std::uint32_t>(kindOfBucket.size());
    kindOfBucket.push_back(scene.materials[m].kind);
  }
  bucketOfMesh.push_back(0);
  for (const gpu::Mesh& mesh : scene.meshes) bucketOfMesh.push_back(bucketOfMaterial[mesh.material]);
}

bool hasPacketInstructions() {
#if defined(__x86_64__)
  return (hwy::SupportedTargets() & (HWY_SSE4 | HWY_AVX2 | HWY_AVX3)) != 0;
#else
  return true;
#endif
}

}  // namespace malus::embree
