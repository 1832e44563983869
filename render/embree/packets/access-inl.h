// Base of the packet tracers: rays, hits and scene data on lanes, as shaders/surfaces/hooks.h names them. Included once
// per instruction set, in its namespace, after lanes-inl.h and the shared structs; no include guard.

// A batch of rays, in structure-of-arrays form. The last register may be written beyond the last ray.
struct Rays {
  HWY_ALIGN_MAX float origin[3][kBatch + kLanes];
  HWY_ALIGN_MAX float direction[3][kBatch + kLanes];
  HWY_ALIGN_MAX float depth[kBatch + kLanes];
#if MALUS_EFFECT_ABSORPTION
  HWY_ALIGN_MAX float originDistance[kBatch + kLanes];
#endif
  std::uint32_t count;
};

// The nearest triangles along a batch of rays, and the order in which they are shaded.
struct Intersections {
  HWY_ALIGN_MAX std::uint32_t mesh[kBatch + kLanes];
  HWY_ALIGN_MAX std::uint32_t triangle[kBatch + kLanes];
  HWY_ALIGN_MAX float b1[kBatch + kLanes];
  HWY_ALIGN_MAX float b2[kBatch + kLanes];
  HWY_ALIGN_MAX std::uint32_t order[kBatch + kLanes];  // indices of the rays
};

FN real loadR(const float* from) { return hn::LoadU(Floats(), from); }
FN word loadW(const std::uint32_t* from) { return hn::LoadU(Words(), from); }
FN void storeR(real a, float* to) { hn::StoreU(a.v, Floats(), to); }
FN real gatherR(const float* from, word index) { return hn::GatherIndex(Floats(), from, hn::BitCast(Ints(), index.v)); }
FN word gatherW(const std::uint32_t* from, word index) {
  return hn::GatherIndex(Words(), from, hn::BitCast(Ints(), index.v));
}
FN void scatterR(real a, float* to, word index) { hn::ScatterIndex(a.v, Floats(), to, hn::BitCast(Ints(), index.v)); }
FN word addW(word a, word b) { return hn::Add(a.v, b.v); }
FN word timesW(word a, std::uint32_t factor) { return hn::Mul(a.v, hn::Set(Words(), factor)); }
FN std::uint32_t firstLane(word a) { return hn::GetLane(a.v); }
FN bool sameInAll(word a) { return hn::AllTrue(Words(), hn::Eq(a.v, hn::Set(Words(), firstLane(a)))); }
FN real3 gather3(const float* from, word index) {
  return {gatherR(from, index), gatherR(from + 1, index), gatherR(from + 2, index)};
}

// The lanes of a that are chosen, next to each other from `to` on.
FN void storeChosen(real a, mask chosen, float* to) { storeR(hn::Compress(a.v, chosen.m), to); }

// Index of each chosen lane when the chosen lanes are numbered from `first` on.
FN word numberChosen(mask chosen, std::uint32_t first) {
  HWY_ALIGN std::uint32_t number[kLanes];
  HWY_ALIGN std::uint32_t isChosen[kLanes];
  hn::Store(selectW(chosen, 1u, 0u).v, Words(), isChosen);
  for (std::size_t i = 0; i < kLanes; ++i) {
    number[i] = first;
    first += isChosen[i];
  }
  return loadW(number);
}

// A row of a table of structs whose members are floats and words of four bytes, per lane.
template <class Struct>
FN Struct gatherRow(const void* table, word row) {
  Struct result;
  constexpr std::size_t kCount = kFields<Struct>;
  const float* values = static_cast<const float*>(table);
  if (sameInAll(row)) {
    values += std::size_t{firstLane(row)} * kCount;
    for (std::size_t i = 0; i < kCount; ++i) setField(result, i, real(values[i]));
    return result;
  }
  const word at = timesW(row, kCount);
  for (std::size_t i = 0; i < kCount; ++i) setField(result, i, gatherR(values + i, at));
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

struct PacketAccess {
  const render::RenderScene* scene;
  const embree::Bvh* bvh;
  const embree::ShadingOrder* shadingOrder;
  gpu::CameraParameters camera;
  MaterialTable materials;
  LightTable lights;
  MaterialExtra extra;  // of the packet that is shaded
  mask active;          // its lanes that have a ray
  std::uint64_t rays;
  std::uint32_t* bucketEnds;  // for sort()

  void begin(const embree::PacketInput& input) {
    scene = input.tile.scene;
    bvh = input.tile.bvh;
    shadingOrder = input.order;
    camera = *input.tile.camera;
    materials = {scene->materials.data()};
    lights = {scene->lights.data()};
    rays = 0;
    bucketEnds = input.bucketEnds;
  }

  const MaterialExtra& materialExtra(word) { return extra; }

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
      if (texture[lane] != gpu::kNoTexture) {
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
      const bool used = texture[lane] != gpu::kNoTexture;
      sizes[0][lane] = used ? static_cast<float>(scene->textures[texture[lane]].width) : 1.0f;
      sizes[1][lane] = used ? static_cast<float>(scene->textures[texture[lane]].height) : 1.0f;
    }
    width = loadR(sizes[0]);
    height = loadR(sizes[1]);
  }

  mask visible(mask needed, const real3& origin, const real3& way) {
    needed = andM(needed, active);
    if (!anyM(needed)) return needed;
    embree::RayPacket<kLanes> query;
    storeR(origin.x, query.org_x), storeR(origin.y, query.org_y), storeR(origin.z, query.org_z);
    storeR(way.x, query.dir_x), storeR(way.y, query.dir_y), storeR(way.z, query.dir_z);
    for (std::size_t i = 0; i < kLanes; ++i) {
      query.tnear[i] = embree::kNearest, query.tfar[i] = 1;
      query.time[i] = 0, query.mask[i] = ~0u, query.id[i] = 0, query.flags[i] = 0;
    }
    HWY_ALIGN_MAX std::uint32_t valid[kLanes];
    hn::Store(selectW(needed, ~0u, 0u).v, Words(), valid);
    bvh->occluded(reinterpret_cast<const int*>(valid), query, false);
    rays += countM(needed);
    return notM(lessR(loadR(query.tfar), 0.0f));
  }

  // Finds the nearest triangles along `batch` and sorts the rays.
  void intersect(const Rays& batch, Intersections& found, bool coherent) {
    const std::uint32_t count = batch.count;
    rays += count;
    embree::RayHitPacket<kLanes> query;
    for (std::size_t i = 0; i < kLanes; ++i) {
      query.ray.time[i] = 0, query.ray.mask[i] = ~0u, query.ray.id[i] = 0, query.ray.flags[i] = 0;
    }
    for (std::uint32_t at = 0; at < count; at += static_cast<std::uint32_t>(kLanes)) {
      HWY_ALIGN_MAX int valid[kLanes];
      for (std::size_t i = 0; i < kLanes; ++i) {
        valid[i] = at + i < count ? -1 : 0;
        query.ray.tnear[i] = embree::kNearest, query.ray.tfar[i] = 1e30f;
        query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      }
      storeR(loadR(batch.origin[0] + at), query.ray.org_x), storeR(loadR(batch.direction[0] + at), query.ray.dir_x);
      storeR(loadR(batch.origin[1] + at), query.ray.org_y), storeR(loadR(batch.direction[1] + at), query.ray.dir_y);
      storeR(loadR(batch.origin[2] + at), query.ray.org_z), storeR(loadR(batch.direction[2] + at), query.ray.dir_z);
      bvh->nearest(valid, query, coherent);
      hn::StoreU(loadW(query.hit.geomID).v, Words(), found.mesh + at);
      hn::StoreU(loadW(query.hit.primID).v, Words(), found.triangle + at);
      storeR(loadR(query.hit.u), found.b1 + at);
      storeR(loadR(query.hit.v), found.b2 + at);
    }
    sort(found, count);
  }

  // The index, or one behind the last for the lanes that are not active: what those store is not read.
  word parked(word index) { return selectW(active, index, static_cast<std::uint32_t>(kBatch)); }

  std::uint32_t bucket(std::uint32_t mesh) {
    return mesh == embree::Intersection::kMiss ? 0 : shadingOrder->bucketOfMesh[mesh];
  }

  // Counting sort by bucket.
  void sort(Intersections& found, std::uint32_t count) {
    const std::size_t buckets = shadingOrder->kindOfBucket.size();
    for (std::size_t b = 0; b < buckets; ++b) bucketEnds[b] = 0;
    for (std::uint32_t i = 0; i < count; ++i) ++bucketEnds[bucket(found.mesh[i])];
    std::uint32_t sum = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
      const std::uint32_t size = bucketEnds[b];
      bucketEnds[b] = sum;
      sum += size;
    }
    for (std::uint32_t i = 0; i < count; ++i) found.order[bucketEnds[bucket(found.mesh[i])]++] = i;
  }

  // Calls leave(ray) for the packets of rays that leave the scene and meet(kind, ray) for those of each kind of
  // surface, with their indices in the batch, and `active` set. The lanes that are not active repeat an active one.
  template <class Leave, class Meet>
  void forEachPacket(const Intersections& found, Leave leave, Meet meet) {
    const std::size_t buckets = shadingOrder->kindOfBucket.size();
    std::uint32_t first = 0;
    for (std::size_t b = 0; b < buckets;) {
      const std::uint32_t kind = shadingOrder->kindOfBucket[b];
      std::uint32_t end = bucketEnds[b];
      std::size_t next = b + 1;
      while (b > 0 && next < buckets && shadingOrder->kindOfBucket[next] == kind) end = bucketEnds[next++];
      for (std::uint32_t at = first; at < end; at += static_cast<std::uint32_t>(kLanes)) {
        const std::uint32_t left = HWY_MIN(end - at, static_cast<std::uint32_t>(kLanes));
        active = hn::FirstN(Floats(), left);
        const word ray = selectW(active, loadW(found.order + at), found.order[end - 1]);
        if (b == 0)
          leave(ray);
        else
          meet(kind, ray);
      }
      first = end;
      b = next;
    }
  }
};
