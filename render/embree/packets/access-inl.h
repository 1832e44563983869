// Base of the packet tracers: rays, hits and scene data on lanes, as shaders/surfaces/hooks.h names them. Included once
// per instruction set, in its namespace, after lanes-inl.h and the shared structs; no include guard.

#include "shaders/surfaces/path_word.h"

// A batch of rays, in structure-of-arrays form. The last register may be written beyond the last ray.
struct Rays {
  HWY_ALIGN_MAX float origin[3][kBatch + kLanes];
  HWY_ALIGN_MAX float direction[3][kBatch + kLanes];
  HWY_ALIGN_MAX float depth[kBatch + kLanes];
#if MALUS_EFFECT_ABSORPTION
  HWY_ALIGN_MAX float originDistance[kBatch + kLanes];
#endif
#if MALUS_PATH_WORD
  HWY_ALIGN_MAX std::uint32_t path[kBatch + kLanes];
#endif
  std::uint32_t count;
};

// The nearest triangles along a batch of rays, and the order in which they are shaded.
struct Intersections {
  HWY_ALIGN_MAX std::uint32_t mesh[kBatch + kLanes];
  HWY_ALIGN_MAX std::uint32_t triangle[kBatch + kLanes];
  HWY_ALIGN_MAX std::uint32_t order[kBatch + kLanes];  // indices of the rays
};

// A key of each ray of a batch.
struct Keys {
  HWY_ALIGN_MAX std::uint32_t key[kBatch + kLanes];
  std::uint64_t mixed;  // bit i: the rays of packet i have several keys
};
static_assert(kBatch / kLanes <= 64);

FN real loadR(const float* from) { return hn::LoadU(Floats(), from); }
FN word loadW(const std::uint32_t* from) { return hn::LoadU(Words(), from); }
FN void storeR(real a, float* to) { hn::StoreU(a.v, Floats(), to); }
FN real gatherR(const float* from, word index) { return hn::GatherIndex(Floats(), from, hn::BitCast(Ints(), index.v)); }
FN word gatherW(const std::uint32_t* from, word index) {
  return hn::GatherIndex(Words(), from, hn::BitCast(Ints(), index.v));
}
FN void scatterR(real a, float* to, word index) { hn::ScatterIndex(a.v, Floats(), to, hn::BitCast(Ints(), index.v)); }
FN std::uint32_t firstLane(word a) { return hn::GetLane(a.v); }
FN bool sameInAll(word a) { return hn::AllTrue(Words(), hn::Eq(a.v, hn::Set(Words(), firstLane(a)))); }
// Whether the lanes are successive numbers.
FN bool isSuccessive(word a) { return hn::AllTrue(Words(), hn::Eq(a.v, hn::Iota(Words(), firstLane(a)))); }
FN real3 gather3(const float* from, std::uint32_t index) { return {from[index], from[index + 1], from[index + 2]}; }
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
// Loads and shuffles are faster than gathers.
using Points = hn::FixedTag<float, 4>;
FN hn::Vec<Points> loadPoint(const float* from) { return hn::MaskedLoad(hn::FirstN(Points(), 3), Points(), from); }
#if HWY_TARGET == HWY_AVX3
// The points k, k + 4, k + 8 and k + 12.
FN real loadPoints(const float* from, const std::uint32_t* index) {
  const hn::FixedTag<float, 8> pairs;
  return hn::Combine(Floats(), hn::Combine(pairs, loadPoint(from + index[12]), loadPoint(from + index[8])),
                     hn::Combine(pairs, loadPoint(from + index[4]), loadPoint(from + index[0])));
}
#else
// The points k and k + 4.
FN real loadPoints(const float* from, const std::uint32_t* index) {
  return hn::Combine(Floats(), loadPoint(from + index[4]), loadPoint(from + index[0]));
}
#endif
FN real3 gather3(const float* from, word index) {
  HWY_ALIGN_MAX std::uint32_t at[kLanes];
  hn::Store(index.v, Words(), at);
  const hn::Repartition<double, Floats> pairs;
  const real p0 = loadPoints(from, at), p1 = loadPoints(from, at + 1);
  const real p2 = loadPoints(from, at + 2), p3 = loadPoints(from, at + 3);
  const auto xy01 = hn::BitCast(pairs, hn::InterleaveLower(Floats(), p0.v, p1.v));
  const auto xy23 = hn::BitCast(pairs, hn::InterleaveLower(Floats(), p2.v, p3.v));
  const auto z01 = hn::BitCast(pairs, hn::InterleaveUpper(Floats(), p0.v, p1.v));
  const auto z23 = hn::BitCast(pairs, hn::InterleaveUpper(Floats(), p2.v, p3.v));
  return {hn::BitCast(Floats(), hn::InterleaveLower(pairs, xy01, xy23)),
          hn::BitCast(Floats(), hn::InterleaveUpper(pairs, xy01, xy23)),
          hn::BitCast(Floats(), hn::InterleaveLower(pairs, z01, z23))};
}
#else
FN real3 gather3(const float* from, word index) {
  return {gatherR(from, index), gatherR(from + 1, index), gatherR(from + 2, index)};
}
#endif

FN void gather3W(const std::uint32_t* from, std::uint32_t index, std::uint32_t& a, std::uint32_t& b, std::uint32_t& c) {
  a = from[index], b = from[index + 1], c = from[index + 2];
}
FN void gather3W(const std::uint32_t* from, word index, word& a, word& b, word& c) {
  const real3 bits = gather3(reinterpret_cast<const float*>(from), index);  // moved, not computed with
  a = floatBits(bits.x), b = floatBits(bits.y), c = floatBits(bits.z);
}

// A permutation of lanes.
using Order = decltype(hn::IndicesFromVec(Floats(), hn::Zero(Ints())));

// Stores the chosen lanes of values next to each other. The permutation is computed once for all values of a packet.
class ChosenLanes {
 public:
  HWY_INLINE explicit ChosenLanes(mask chosen)
      : order_(hn::IndicesFromVec(Floats(), hn::Compress(hn::Iota(Ints(), 0), hn::RebindMask(Ints(), chosen.m)))) {}
  HWY_INLINE void store(real a, float* to) const { storeR(hn::TableLookupLanes(a.v, order_), to); }
  HWY_INLINE void store(word a, std::uint32_t* to) const {
    hn::StoreU(hn::BitCast(Words(), hn::TableLookupLanes(hn::BitCast(Floats(), a.v), order_)), Words(), to);
  }

 private:
  Order order_;
};

// Number of chosen lanes before each lane. The bits of the mask become numbers of four bits, which one multiplication
// adds up.
FN Order rankChosen(mask chosen) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(Floats(), chosen.m, reinterpret_cast<std::uint8_t*>(&bits));
  bits = (bits | bits << 24u) & 0x000000ff000000ffu;
  bits = (bits | bits << 12u) & 0x000f000f000f000fu;
  bits = (bits | bits << 6u) & 0x0303030303030303u;
  bits = (bits | bits << 3u) & 0x1111111111111111u;
  const std::uint64_t ranks = (bits << 4u) * 0x1111111111111111u;
  const auto lane = hn::Iota(Words(), 0);
  const auto low = hn::Set(Words(), static_cast<std::uint32_t>(ranks));
  const auto high = hn::Set(Words(), static_cast<std::uint32_t>(ranks >> 32u));
  const auto half = hn::IfThenElse(hn::Lt(lane, hn::Set(Words(), 8u)), low, high);
  const auto shift = hn::ShiftLeft<2>(hn::And(lane, hn::Set(Words(), 7u)));
  return hn::IndicesFromVec(Floats(), hn::BitCast(Ints(), hn::And(hn::Shr(half, shift), hn::Set(Words(), 15u))));
}

// The inverse of ChosenLanes::store: the values from `from` on, in the lanes that were chosen.
FN real loadChosen(const float* from, Order ranks) { return hn::TableLookupLanes(loadR(from).v, ranks); }
FN word loadChosen(const std::uint32_t* from, Order ranks) {
  return hn::BitCast(Words(), hn::TableLookupLanes(hn::BitCast(Floats(), loadW(from).v), ranks));
}

// A row of a table of structs whose members are floats and words of four bytes, per lane.
template <class Struct>
FN void gatherRow(const void* table, word row, Struct& result) {
  constexpr std::size_t kCount = kFields<Struct>;
  const float* values = static_cast<const float*>(table);
  if (sameInAll(row)) {
    values += std::size_t{firstLane(row)} * kCount;
    for (std::size_t i = 0; i < kCount; ++i) setField(result, i, real(values[i]));
    return;
  }
  const word at = timesW(row, kCount);
  for (std::size_t i = 0; i < kCount; ++i) setField(result, i, gatherR(values + i, at));
}
template <class Struct>
FN Struct gatherRow(const void* table, word row) {
  Struct result;
  gatherRow(table, row, result);
  return result;
}

struct MaterialTable {
  const gpu::Material* rows;
  Material operator[](word index) { return gatherRow<Material>(rows, index); }
};
struct LightTable {
  const gpu::PointLight* rows;
  PointLight operator[](int index) { return gatherRow<PointLight>(rows, static_cast<std::uint32_t>(index)); }
};

struct MeshRow {
  word firstTriangle, firstVertex, material, hasNormals;
  real3 origin;
};
static_assert(kFields<MeshRow> * 4 == sizeof(gpu::Mesh) && kFields<Material> * 4 == sizeof(gpu::Material));
static_assert(kFields<MaterialExtra> * 4 == sizeof(gpu::MaterialExtra));
static_assert(kFields<LightShape> * 4 == sizeof(gpu::LightShape));
static_assert(kFields<MeshMaps> * 4 == sizeof(gpu::MeshMaps) && kFields<TextureMap> * 4 == sizeof(gpu::TextureMap));
static_assert(kFields<MeshTransform> * 4 == sizeof(gpu::MeshTransform));
static_assert(kFields<AreaLight> * 4 == sizeof(gpu::AreaLight) && kFields<LightNode> * 4 == sizeof(gpu::LightNode));

struct PacketAccess {
  const render::RenderScene* scene;
  const embree::Bvh* bvh;
  const embree::ShadingOrder* shadingOrder;
  gpu::CameraParameters camera;
  MaterialTable materials;
  LightTable lights;
  MaterialExtra extra;  // of the packet that is shaded
  word extraOf;         // its materials
  mask active;          // its lanes that have a ray
  std::uint64_t rays;
  std::span<std::uint32_t> bucketEnds;                       // of the batch that was traced last
  embree::RayHitPacket<kLanes> nearestQuery;                 // initialized by begin()
  embree::RayPacket<kLanes> shadowQuery;                     // the same
  HWY_ALIGN_MAX std::uint32_t octantOrder[kBatch + kLanes];  // indices of its rays, by octant
  Keys octants;                                              // of a batch
  Keys buckets;                                              // of its hits

  void begin(const embree::PacketInput& input) {
    scene = input.tile.scene;
    bvh = input.tile.bvh;
    shadingOrder = input.order;
    camera = *input.tile.camera;
    materials = {scene->materials.data()};
    lights = {scene->lights.data()};
    rays = 0;
    extraOf = ~0u;
    bucketEnds = input.bucketEnds;
    embree::initializeRay(nearestQuery.ray);
    embree::setField(nearestQuery.hit.instID[0], embree::Intersection::kMiss);
    embree::initializeRay(shadowQuery);
  }

  const MaterialExtra& materialExtra(word) { return extra; }

  LightShape lightShape(int index) {
    return gatherRow<LightShape>(scene->lightShapes.data(), static_cast<std::uint32_t>(index));
  }

  AreaLight areaLight(word index) { return gatherRow<AreaLight>(scene->areaLights.data(), index); }
  LightNode lightNode(word index) { return gatherRow<LightNode>(scene->lightNodes.data(), index); }

  real environmentDistribution(real index) {
    return gatherR(scene->environmentDistributions.data(), wordOfReal(index));
  }

  real3 environmentTexel(real x, real y) {
    const word row = timesW(wordOfReal(y), static_cast<std::uint32_t>(camera.environmentSize + 2));
    return gather3(&scene->environmentTexels.data()->x, timesW(addW(row, wordOfReal(x)), 3));
  }

  // Lane by lane: textures differ in size.
  real3 texel(word index, real x, real y) {
    HWY_ALIGN std::uint32_t texture[kLanes];
    HWY_ALIGN float column[kLanes], row[kLanes], texels[3][kLanes];
    hn::Store(index.v, Words(), texture);
    hn::Store(x.v, Floats(), column);
    hn::Store(y.v, Floats(), row);
    const auto repeated = [](int i, int size) HWY_ATTR { return i < 0 ? i + size : i >= size ? i - size : i; };
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      glm::vec3 value(0);
      if (texture[lane] < scene->textures.size()) {
        const gpu::Texture& t = scene->textures[texture[lane]];
        const int width = static_cast<int>(t.width), height = static_cast<int>(t.height);
        value = scene->textureTexels[t.first +
                                     static_cast<std::uint32_t>(repeated(static_cast<int>(row[lane]), height) * width +
                                                                repeated(static_cast<int>(column[lane]), width))];
      }
      for (int i = 0; i < 3; ++i) texels[i][lane] = value[i];
    }
    return {loadR(texels[0]), loadR(texels[1]), loadR(texels[2])};
  }
  void textureSize(word index, real& width, real& height) {
    HWY_ALIGN std::uint32_t texture[kLanes];
    HWY_ALIGN float sizes[2][kLanes];
    hn::Store(index.v, Words(), texture);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const bool used = texture[lane] < scene->textures.size();
      sizes[0][lane] = used ? static_cast<float>(scene->textures[texture[lane]].width) : 1.0f;
      sizes[1][lane] = used ? static_cast<float>(scene->textures[texture[lane]].height) : 1.0f;
    }
    width = loadR(sizes[0]);
    height = loadR(sizes[1]);
  }

  bool hasMeshTextures() const { return scene->hasMeshTextures; }
  MeshMaps meshMaps(word material) { return gatherRow<MeshMaps>(scene->materialMaps.data(), material); }
  TextureMap textureMap(word map) { return gatherRow<TextureMap>(scene->textureMaps.data(), map); }
  word textureRow(word index, real level) { return addW(index, wordOfReal(level)); }

  mask visible(mask needed, const real3& origin, const real3& way) {
    needed = andM(needed, active);
    if (!anyM(needed)) return needed;
    embree::RayPacket<kLanes>& query = shadowQuery;
    storeR(origin.x, query.org_x), storeR(origin.y, query.org_y), storeR(origin.z, query.org_z);
    storeR(way.x, query.dir_x), storeR(way.y, query.dir_y), storeR(way.z, query.dir_z);
    storeR(1.0f, query.tfar);
    HWY_ALIGN_MAX std::uint32_t valid[kLanes];
    hn::Store(selectW(needed, ~0u, 0u).v, Words(), valid);
    bvh->occluded(reinterpret_cast<const int*>(valid), query, false);
    rays += countM(needed);
    return notM(lessR(loadR(query.tfar), 0.0f));
  }

#include "render/embree/packets/intersect-inl.h"
};
