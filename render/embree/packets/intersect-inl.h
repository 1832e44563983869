// Finds the nearest triangles along a batch of rays and the order in which they are shaded: members of the base of the
// packet tracers. Included once per instruction set; no include guard.

// Embree traces packets whose rays are in one octant of directions fastest by its coherent calls, others by its
// incoherent ones (`malus bench rays`). If more than one packet of this many is in several octants, the batch is
// sorted.
static constexpr std::uint32_t kMostMixed = 4;

// Stores the keys of the packet that begins at ray `at` of a batch of `count`.
static void storeKeys(word key, std::uint32_t at, std::uint32_t count, Keys& keys) {
  hn::StoreU(key.v, Words(), keys.key + at);
  const std::uint32_t left = count - at;
  const bool isMixed = !sameInAll(left < kLanes ? selectW(hn::FirstN(Floats(), left), key, firstLane(key)) : key);
  keys.mixed |= std::uint64_t{isMixed} << (at / kLanes);
}

static void sortByKey(const Keys& keys, std::uint32_t count, std::span<std::uint32_t> ends, std::uint32_t* order) {
  constexpr auto kRun = static_cast<std::uint32_t>(kLanes);
  const auto hasOneKey = [&](std::uint32_t first) {
    return first + kRun <= count && (keys.mixed >> (first / kRun) & 1u) == 0;
  };
  embree::countingSort(keys.key, count, kRun, hasOneKey, ends, order);
}

// The octants of a batch (embree::octant).
void findOctants(const Rays& batch) {
  octants.mixed = 0;
  for (std::uint32_t at = 0; at < batch.count; at += static_cast<std::uint32_t>(kLanes)) {
    const auto sign = [&](int axis) HWY_ATTR {
      return hn::ShiftRight<31>(hn::BitCast(Words(), loadR(batch.direction[axis] + at).v));
    };
    storeKeys(hn::Or(hn::Or(sign(0), hn::ShiftLeft<1>(sign(1))), hn::ShiftLeft<2>(sign(2))), at, batch.count, octants);
  }
}

// Traces up to a packet of rays: the meshes and triangles are in nearestQuery. row(values): a packet of a row of the
// batch.
template <class Row>
void tracePacket(const Rays& batch, mask needed, bool coherent, Row row) {
  embree::RayHitPacket<kLanes>& query = nearestQuery;
  HWY_ALIGN_MAX std::uint32_t valid[kLanes];
  hn::Store(selectW(needed, ~0u, 0u).v, Words(), valid);
  storeR(row(batch.origin[0]), query.ray.org_x), storeR(row(batch.direction[0]), query.ray.dir_x);
  storeR(row(batch.origin[1]), query.ray.org_y), storeR(row(batch.direction[1]), query.ray.dir_y);
  storeR(row(batch.origin[2]), query.ray.org_z), storeR(row(batch.direction[2]), query.ray.dir_z);
  embree::initializeHit(query);
  bvh->nearest(reinterpret_cast<const int*>(valid), query, coherent);
}

// The meshes that the packet in nearestQuery meets (Bvh::hitMesh).
word foundMesh() {
  const word geometry = loadW(nearestQuery.hit.geomID);
#if MALUS_EFFECT_INSTANCES
  if (bvh->hasInstances())
    return addW(geometry, gatherW(bvh->firstMeshes(), addW(loadW(nearestQuery.hit.instID[0]), word(1u))));
#endif
  return geometry;
}

// Finds the nearest triangles along `batch` and sorts the rays by material.
void intersect(const Rays& batch, Intersections& found) {
  const std::uint32_t count = batch.count;
  rays += count;
  findOctants(batch);
  const bool sorts = static_cast<std::size_t>(std::popcount(octants.mixed)) * kMostMixed * kLanes > count;
  if (sorts) {
    std::uint32_t ends[embree::kOctants];
    sortByKey(octants, count, ends, octantOrder);
  }
  for (std::uint32_t at = 0; at < count; at += static_cast<std::uint32_t>(kLanes)) {
    const mask needed = hn::FirstN(Floats(), count - at);
    if (sorts) {
      const word ray = selectW(needed, loadW(octantOrder + at), octantOrder[at]);
      const bool coherent = sameInAll(gatherW(octants.key, ray));
      tracePacket(batch, needed, coherent, [&](const float* values) HWY_ATTR { return gatherR(values, ray); });
      const word to = selectW(needed, ray, static_cast<std::uint32_t>(kBatch));
      hn::ScatterIndex(foundMesh().v, Words(), found.mesh, hn::BitCast(Ints(), to.v));
      hn::ScatterIndex(loadW(nearestQuery.hit.primID).v, Words(), found.triangle, hn::BitCast(Ints(), to.v));
    } else {
      const bool coherent = sameInAll(selectW(needed, loadW(octants.key + at), octants.key[at]));
      tracePacket(batch, needed, coherent, [&](const float* values) HWY_ATTR { return loadR(values + at); });
      hn::StoreU(foundMesh().v, Words(), found.mesh + at);
      hn::StoreU(loadW(nearestQuery.hit.primID).v, Words(), found.triangle + at);
    }
  }
  sortByMaterial(found, count);
}

// A ray that misses has mesh -1, and bucket 0.
void sortByMaterial(Intersections& found, std::uint32_t count) {
  buckets.mixed = 0;
  static_assert(embree::Intersection::kMiss + 1 == 0);
  for (std::uint32_t at = 0; at < count; at += static_cast<std::uint32_t>(kLanes)) {
    const word row = selectW(hn::FirstN(Floats(), count - at), addW(loadW(found.mesh + at), 1), 0u);
    storeKeys(gatherW(shadingOrder->bucketOfMesh.data(), row), at, count, buckets);
  }
  sortByKey(buckets, count, bucketEnds, found.order);
}

// The index, or one behind the last for the lanes that are not active: what those store is not read.
word parked(word index) { return selectW(active, index, static_cast<std::uint32_t>(kBatch)); }

// Calls leave(ray) for the packets of rays that leave the scene and meet(kind, ray) for those of each kind of
// surface, with their indices in the batch, and `active` set. The lanes that are not active repeat an active one.
template <class Leave, class Meet>
void forEachPacket(const Intersections& found, Leave leave, Meet meet) {
  const std::size_t count = shadingOrder->kindOfBucket.size();
  std::uint32_t first = 0;
  for (std::size_t b = 0; b < count;) {
    const std::uint32_t kind = shadingOrder->kindOfBucket[b];
    std::uint32_t end = bucketEnds[b];
    std::size_t next = b + 1;
    while (b > 0 && next < count && shadingOrder->kindOfBucket[next] == kind) end = bucketEnds[next++];
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
