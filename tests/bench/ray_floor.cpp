// Traces the rays of a file of `malus bench rays --write-rays` by Embree, one at a time and in packets of 8, and does
// nothing else: an independent check of the floor that the bench prints. It has its own scene, its own calls and one
// thread.
//
//   ray_floor PACK RAYS     prints {"classes": [{depth, shadow, rays, hits, packetHits, singleMs, packetMs}]}
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "meshprep/base/error.h"
#include "render/embree/embree.h"  // the header of Embree 3 or 4
#include "render/scene/render_scene.h"

namespace {

struct Rays {
  int bounce = 0, shadow = 0;
  std::size_t count = 0;
  std::vector<float> values[6];
};

std::vector<Rays> readRays(const char* file) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!std::getline(in, line) || line != "malus-rays 1") throw malus::Error(file, "not a file of rays", "malus-rays 1");
  std::vector<Rays> all;
  while (std::getline(in, line)) {
    Rays& rays = all.emplace_back();
    if (std::sscanf(line.c_str(), "%d %d %zu", &rays.bounce, &rays.shadow, &rays.count) != 3)
      throw malus::Error(file, "bad line", "BOUNCE SHADOW COUNT", line);
    for (std::vector<float>& values : rays.values) {
      values.resize(rays.count);
      in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(rays.count * sizeof(float)));
    }
    if (!in) throw malus::Error(file, "ends early", line);
  }
  return all;
}

// One instance per mesh, moved to the mesh's origin.
RTCScene makeScene(RTCDevice device, const malus::render::RenderScene& scene) {
  RTCScene top = rtcNewScene(device);
  rtcSetSceneFlags(top, RTC_SCENE_FLAG_ROBUST);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (scene.meshTriangles[i] == 0) continue;
    RTCScene inner = rtcNewScene(device);
    rtcSetSceneFlags(inner, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* p = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, scene.meshVertices[i]));
    auto* t = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, scene.meshTriangles[i]));
    std::copy_n(scene.positions.data() + scene.meshes[i].firstVertex, scene.meshVertices[i], p);
    std::copy_n(scene.triangles.data() + scene.meshes[i].firstTriangle, scene.meshTriangles[i], t);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(inner, mesh);
    rtcCommitScene(inner);
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, inner);
    const glm::vec3& at = scene.meshes[i].origin;
    const float transform[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, at.x, at.y, at.z};
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform);
    rtcCommitGeometry(instance);
    rtcAttachGeometry(top, instance);
  }
  rtcCommitScene(top);
  return top;
}

// Writes a ray into the lane of a query: origin, direction, nearest and farthest distance.
void fill(const Rays& rays, std::size_t index, std::size_t lane, float* fields[8]) {
  for (int i = 0; i < 6; ++i) fields[i][lane] = rays.values[i][index];
  fields[6][lane] = malus::embree::kNearest;
  fields[7][lane] = rays.shadow ? 1.0f : malus::embree::kFarthest;
}

// Traces all rays in packets of 8, the last one filled up; returns the hits.
std::size_t tracePackets(RTCScene scene, const Rays& rays) {
  std::size_t hits = 0;
  RTCRayHit8 q{};
  std::fill_n(q.ray.mask, 8, ~0u);
  float* fields[8] = {q.ray.org_x, q.ray.org_y, q.ray.org_z, q.ray.dir_x,
                      q.ray.dir_y, q.ray.dir_z, q.ray.tnear, q.ray.tfar};
  alignas(32) const int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
  for (std::size_t at = 0; at < rays.count; at += 8) {
    for (std::size_t lane = 0; lane < 8; ++lane) fill(rays, std::min(at + lane, rays.count - 1), lane, fields);
    std::fill_n(q.hit.geomID, 8, RTC_INVALID_GEOMETRY_ID);
#if RTC_VERSION_MAJOR >= 4
    if (rays.shadow)
      rtcOccluded8(valid, scene, &q.ray, nullptr);
    else
      rtcIntersect8(valid, scene, &q, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (rays.shadow)
      rtcOccluded8(valid, scene, &context, &q.ray);
    else
      rtcIntersect8(valid, scene, &context, &q);
#endif
    for (std::size_t lane = 0; lane < std::min<std::size_t>(8, rays.count - at); ++lane)
      hits += rays.shadow ? q.ray.tfar[lane] < 0 : q.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
  }
  return hits;
}

std::size_t traceSingle(RTCScene scene, const Rays& rays) {
  std::size_t hits = 0;
  RTCRayHit q{};
  q.ray.mask = ~0u;
  float* fields[8] = {&q.ray.org_x, &q.ray.org_y, &q.ray.org_z, &q.ray.dir_x,
                      &q.ray.dir_y, &q.ray.dir_z, &q.ray.tnear, &q.ray.tfar};
  for (std::size_t at = 0; at < rays.count; ++at) {
    fill(rays, at, 0, fields);
    q.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    if (rays.shadow)
      rtcOccluded1(scene, &q.ray, nullptr);
    else
      rtcIntersect1(scene, &q, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (rays.shadow)
      rtcOccluded1(scene, &context, &q.ray);
    else
      rtcIntersect1(scene, &context, &q);
#endif
    hits += rays.shadow ? q.ray.tfar < 0 : q.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  return hits;
}

// Calls trace() five times; returns the least time [ms].
template <class Trace>
double leastMs(Trace trace) {
  double least = 1e300;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    trace();
    least =
        std::min(least, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "ray_floor: expected PACK RAYS\n");
    return 2;
  }
  try {
    const malus::pack::Pack pack = malus::pack::read(argv[1]);
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = makeScene(device, malus::render::makeRenderScene(pack.scene));
    nlohmann::json classes = nlohmann::json::array();
    for (const Rays& rays : readRays(argv[2])) {
      std::size_t hits = 0, packetHits = 0;
      const double singleMs = leastMs([&] { hits = traceSingle(scene, rays); });
      const double packetMs = leastMs([&] { packetHits = tracePackets(scene, rays); });
      classes.push_back({{"depth", rays.bounce},
                         {"shadow", rays.shadow != 0},
                         {"rays", rays.count},
                         {"hits", hits},
                         {"packetHits", packetHits},
                         {"singleMs", singleMs},
                         {"packetMs", packetMs}});
    }
    std::printf("%s\n", nlohmann::json{{"classes", classes}}.dump(1).c_str());
  } catch (const malus::Error& error) {
    std::fprintf(stderr, "ray_floor: %s\n", error.what());
    return 1;
  }
}
