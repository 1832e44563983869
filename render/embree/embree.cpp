#include "render/embree/embree.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::embree {

std::string Bvh::version() {
  return fmt::format("Embree {}.{}.{}", RTC_VERSION_MAJOR, RTC_VERSION_MINOR, RTC_VERSION_PATCH);
}

Bvh::Bvh(const render::RenderScene& scene, unsigned threads) {
  device_ = rtcNewDevice(threads == 0 ? "" : fmt::format("threads={}", threads).c_str());
  if (!device_)
    throw Error("Embree", "cannot create a device", "a working Embree library",
                fmt::format("error {}", static_cast<int>(rtcGetDeviceError(nullptr))));
  scene_ = newScene();
  RTCScene placed = nullptr;  // that of the last mesh with instances
  std::uint32_t shape = 0;
  for (const render::MeshRun& run : render::findMeshRuns(scene)) {
    if (!run.isPlaced && scene.meshes[run.first].origin == glm::vec3(0)) {
      attachMeshes(scene_, scene, run, run.first);
      continue;
    }
    if (placed == nullptr || !run.isPlaced || run.shape != shape) {
      if (placed) rtcReleaseScene(placed);
      placed = newScene();
      shape = run.shape;
      attachMeshes(placed, scene, run, run.isPlaced ? 0 : run.first);
      rtcCommitScene(placed);
    }
    attachInstance(placed, scene, run);
  }
  if (placed) rtcReleaseScene(placed);
  rtcCommitScene(scene_);
  if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE)
    throw Error("Embree", "cannot build the acceleration structure", "enough memory",
                fmt::format("error {}", static_cast<int>(error)));
}

RTCScene Bvh::newScene() {
  RTCScene scene = rtcNewScene(device_);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  return scene;
}

namespace {

// Continues the rays of a packet whose hit is cut out.
void ignoreCutOuts(const RTCFilterFunctionNArguments* arguments) {
  const auto& cutOut = *static_cast<const CutOut*>(arguments->geometryUserPtr);
  for (unsigned i = 0; i < arguments->N; ++i)
    if (arguments->valid[i] == -1 &&
        cutOut.isCutOut(RTCHitN_primID(arguments->hit, arguments->N, i), RTCHitN_u(arguments->hit, arguments->N, i),
                        RTCHitN_v(arguments->hit, arguments->N, i)))
      arguments->valid[i] = 0;
}

}  // namespace

// The geometries have the indices of their meshes, also inside an instance of a run; that of a mesh with instances has
// 0. Those of the scene itself come first, so that instances get other indices.
void Bvh::attachMeshes(RTCScene to, const render::RenderScene& scene, const render::MeshRun& run, unsigned firstId) {
  for (std::size_t i = run.first; i < run.first + run.count; ++i) {
    if (scene.meshTriangles[i] == 0) continue;
    // Embree allocates the buffers: it reads 16 bytes per vertex, although a vertex has 12.
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                             scene.meshVertices[i]);
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                            scene.meshTriangles[i]);
    if (vertices && indices) {
      std::memcpy(vertices, scene.positions.data() + scene.meshes[i].firstVertex,
                  scene.meshVertices[i] * sizeof(glm::vec3));
      std::memcpy(indices, scene.triangles.data() + scene.meshes[i].firstTriangle,
                  scene.meshTriangles[i] * sizeof(glm::uvec3));
    }
    if (render::hasCutOuts(scene, i)) {
      cutOuts_.push_back(std::make_unique<const CutOut>(scene, i));
      rtcSetGeometryUserData(geometry, const_cast<CutOut*>(cutOuts_.back().get()));
      rtcSetGeometryIntersectFilterFunction(geometry, ignoreCutOuts);
      rtcSetGeometryOccludedFilterFunction(geometry, ignoreCutOuts);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(to, geometry, firstId + static_cast<unsigned>(i - run.first));
    rtcReleaseGeometry(geometry);
    ++counts_.geometries;
  }
}

void Bvh::attachInstance(RTCScene instanced, const render::RenderScene& scene, const render::MeshRun& run) {
  RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, instanced);
  const gpu::MeshTransform& t = scene.meshTransforms[run.first];
  const glm::vec3 columns[4] = {t.linearX, t.linearY, t.linearZ, scene.meshes[run.first].origin};
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  rtcCommitGeometry(instance);
  const unsigned id = rtcAttachGeometry(scene_, instance);
  rtcReleaseGeometry(instance);
  ++counts_.instances;
  hasInstances_ = hasInstances_ || run.isPlaced;
  if (firstMeshes_.size() < std::size_t{id} + 2) firstMeshes_.resize(std::size_t{id} + 2, 0);
  firstMeshes_[std::size_t{id} + 1] = run.isPlaced ? run.first : 0;
}

namespace {
// Arguments of a packet query, and its call, in Embree 3 and 4.
#if RTC_VERSION_MAJOR >= 4
struct Intersect : RTCIntersectArguments {
  explicit Intersect(bool coherent) {
    rtcInitIntersectArguments(this);
    flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  }
};
struct Occluded : RTCOccludedArguments {
  explicit Occluded(bool coherent) {
    rtcInitOccludedArguments(this);
    flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  }
};
template <class Query, class Packet, class Arguments>
void call(Query query, const int* valid, RTCScene scene, Packet& packet, Arguments arguments) {
  query(valid, scene, &packet, &arguments);
}
#else
struct Intersect : RTCIntersectContext {
  explicit Intersect(bool coherent) {
    rtcInitIntersectContext(this);
    flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
};
using Occluded = Intersect;
template <class Query, class Packet, class Context>
void call(Query query, const int* valid, RTCScene scene, Packet& packet, Context context) {
  query(valid, scene, &context, &packet);
}
#endif
}  // namespace

void Bvh::nearest(const int* valid, RTCRayHit4& packet, bool coherent) const {
  call(rtcIntersect4, valid, scene_, packet, Intersect(coherent));
}
void Bvh::nearest(const int* valid, RTCRayHit8& packet, bool coherent) const {
  call(rtcIntersect8, valid, scene_, packet, Intersect(coherent));
}
void Bvh::nearest(const int* valid, RTCRayHit16& packet, bool coherent) const {
  call(rtcIntersect16, valid, scene_, packet, Intersect(coherent));
}
void Bvh::occluded(const int* valid, RTCRay4& packet, bool coherent) const {
  call(rtcOccluded4, valid, scene_, packet, Occluded(coherent));
}
void Bvh::occluded(const int* valid, RTCRay8& packet, bool coherent) const {
  call(rtcOccluded8, valid, scene_, packet, Occluded(coherent));
}
void Bvh::occluded(const int* valid, RTCRay16& packet, bool coherent) const {
  call(rtcOccluded16, valid, scene_, packet, Occluded(coherent));
}

bool Bvh::isNative(unsigned width) const {
  switch (width) {
    case 1:
      return true;
    case 4:
      return rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED) != 0;
    case 8:
      return rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0;
    case 16:
      return rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
    default:
      return false;
  }
}

Bvh::~Bvh() {
  if (scene_) rtcReleaseScene(scene_);
  if (device_) rtcReleaseDevice(device_);
}

}  // namespace malus::embree
