#include "render/embree/coverage.h"

#include <algorithm>
#include <array>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "render/embree/embree.h"
#include "render/scene/render_scene.h"
#include "shaders/optics/optics.h"

namespace malus::embree {

namespace {

constexpr std::uint32_t kPacket = 16;

// Sets the ray through a sample of the image in a packet; the same expressions as in
// shaders/surfaces/sample_direction.h.
void setRay(RTCRay16& ray, std::uint32_t lane, const gpu::CameraParameters& camera, float column, float row) {
  glm::vec3 origin = camera.position, direction = camera.forward;
  if (camera.orthographic != 0)
    origin += f32::cameraSampleOffset(camera.firstSample, camera.firstSampleFine, camera.columnStep,
                                      camera.columnStepFine, camera.rowStep, camera.rowStepFine, column, row);
  else
    direction = f32::cameraSampleDirection(camera.firstSample, camera.firstSampleFine, camera.columnStep,
                                           camera.columnStepFine, camera.rowStep, camera.rowStepFine, column, row);
  ray.org_x[lane] = origin.x, ray.org_y[lane] = origin.y, ray.org_z[lane] = origin.z;
  ray.dir_x[lane] = direction.x, ray.dir_y[lane] = direction.y, ray.dir_z[lane] = direction.z;
}

// Adds 1 to each of `count` pixels from x on whose ray through a sample meets a surface. column, row: of the sample in
// its pixel.
void addHits(const Bvh& bvh, const gpu::CameraParameters& camera, std::uint32_t x, std::uint32_t y, std::uint32_t count,
             std::uint32_t column, std::uint32_t row, float* pixels) {
  RTCRayHit16 packet;
  initializeRay(packet.ray);
  initializeHit(packet);
  alignas(64) std::array<int, kPacket> valid{};
  for (std::uint32_t lane = 0; lane < kPacket; ++lane) {
    valid[lane] = lane < count ? -1 : 0;
    const std::uint32_t inside = std::min(lane, count - 1);
    setRay(packet.ray, lane, camera, static_cast<float>((camera.regionX + x + inside) * camera.samples + column),
           static_cast<float>((camera.regionY + y) * camera.samples + row));
  }
  bvh.nearest(valid.data(), packet, true);
  for (std::uint32_t lane = 0; lane < count; ++lane)
    if (packet.hit.geomID[lane] != Intersection::kMiss) ++pixels[lane];
}

}  // namespace

std::vector<float> coverage(const pack::Scene& source, const render::RenderParameters& parameters, unsigned threads) {
  const render::RenderScene scene = render::makeRenderScene(source);
  const Bvh bvh(scene, threads);
  const gpu::CameraParameters camera = render::makeCameraParameters(source, parameters);
  const std::uint32_t width = camera.regionWidth, samples = camera.samples;
  std::vector<float> result(std::size_t{width} * camera.regionHeight);
  namespace tbb = oneapi::tbb;
  tbb::task_arena(threads > 0 ? static_cast<int>(threads) : tbb::task_arena::automatic).execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, camera.regionHeight), [&](const auto& rows) {
      for (std::uint32_t y = rows.begin(); y < rows.end(); ++y)
        for (std::uint32_t x = 0; x < width; x += kPacket)
          for (std::uint32_t sample = 0; sample < samples * samples; ++sample)
            addHits(bvh, camera, x, y, std::min(kPacket, width - x), sample % samples, sample / samples,
                    result.data() + std::size_t{y} * width + x);
    });
  });
  const float scale = 1 / static_cast<float>(samples * samples);
  for (float& value : result) value *= scale;
  return result;
}

}  // namespace malus::embree
