// Finds the nearest triangles along a batch of rays and the order in which they are shaded: members of the base of the
// packet tracers. Included once per instruction set; no include guard.

// Embree traces packets whose rays are in one octant of directions fastest by its coherent calls, others by its
// incoherent ones (`malus bench rays`). If more than one packet of this many is in several octants, the batch is
// sorted.
static constexpr std::uint32_t kMostMixed = 4;

// The octants of a batch; returns how many packets are in several.
std::uint32_t findOctants(const Rays& batch) {
  std::uint32_t mixed = 0;
  for (std::uint32_t at = 0; at < batch.count; at += static_cast<std::uint32_t>(kLanes)) {
    const auto sign = [&](int axis) HWY_ATTR {
      return hn::ShiftRight<31>(hn::BitCast(Words(), loadR(batch.direction[axis] + at).v));
    };
    const word octant = hn::Or(hn::Or(sign(0), hn::ShiftLeft<1>(sign(1))), hn::ShiftLeft<2>(sign(2)));
    hn::StoreU(octant.v, Words(), octants + at);
    mixed += !sameInAll(selectW(hn::FirstN(Floats(), batch.count - at), octant, firstLane(octant)));
  }
  return mixed;
}

// Counting sort.
void sortByOctant(std::uint32_t count) {
  std::uint32_t ends[8] = {};
  for (std::uint32_t i = 0; i < count; ++i) ++ends[octants[i]];
  std::uint32_t sum = 0;
  for (std::uint32_t& end : ends) {
    const std::uint32_t size = end;
    end = sum;
    sum += size;
  }
  for (std::uint32_t i = 0; i < count; ++i) octantOrder[ends[octants[i]]++] = i;
}

// Traces up to a packet of rays and returns the meshes and triangles. row(values): a packet of a row of the batch.
template <class Row>
void tracePacket(const Rays& batch, embree::RayHitPacket<kLanes>& query, mask needed, bool coherent, Row row) {
  HWY_ALIGN_MAX std::uint32_t valid[kLanes];
  hn::Store(selectW(needed, ~0u, 0u).v, Words(), valid);
  storeR(row(batch.origin[0]), query.ray.org_x), storeR(row(batch.direction[0]), query.ray.dir_x);
  storeR(row(batch.origin[1]), query.ray.org_y), storeR(row(batch.direction[1]), query.ray.dir_y);
  storeR(row(batch.origin[2]), query.ray.org_z), storeR(row(batch.direction[2]), query.ray.dir_z);
  for (std::size_t i = 0; i < kLanes; ++i) {
    query.ray.tnear[i] = embree::kNearest, query.ray.tfar[i] = 1e30f;
    query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  bvh->nearest(reinterpret_cast<const int*>(valid), query, coherent);
}

// Finds the nearest triangles along `batch` and sorts the rays by material.
void intersect(const Rays& batch, Intersections& found) {
  const std::uint32_t count = batch.count;
  rays += count;
  embree::RayHitPacket<kLanes> query;
  for (std::size_t i = 0; i < kLanes; ++i)
    query.ray.time[i] = 0, query.ray.mask[i] = ~0u, query.ray.id[i] = 0, query.ray.flags[i] = 0;
  const bool sorts = findOctants(batch) * kMostMixed * kLanes > count;
  if (sorts) sortByOctant(count);
  for (std::uint32_t at = 0; at < count; at += static_cast<std::uint32_t>(kLanes)) {
    const mask needed = hn::FirstN(Floats(), count - at);
    if (sorts) {
      const word ray = selectW(needed, loadW(octantOrder + at), octantOrder[at]);
      const bool coherent = sameInAll(hn::GatherIndex(Words(), octants, hn::BitCast(Ints(), ray.v)));
      tracePacket(batch, query, needed, coherent, [&](const float* values) HWY_ATTR { return gatherR(values, ray); });
      const word to = selectW(needed, ray, static_cast<std::uint32_t>(kBatch));
      hn::ScatterIndex(loadW(query.hit.geomID).v, Words(), found.mesh, hn::BitCast(Ints(), to.v));
      hn::ScatterIndex(loadW(query.hit.primID).v, Words(), found.triangle, hn::BitCast(Ints(), to.v));
    } else {
      const bool coherent = sameInAll(selectW(needed, loadW(octants + at), octants[at]));
      tracePacket(batch, query, needed, coherent, [&](const float* values) HWY_ATTR { return loadR(values + at); });
      hn::StoreU(loadW(query.hit.geomID).v, Words(), found.mesh + at);
      hn::StoreU(loadW(query.hit.primID).v, Words(), found.triangle + at);
    }
  }
  sortByMaterial(found, count);
}

// The index, or one behind the last for the lanes that are not active: what those store is not read.
word parked(word index) { return selectW(active, index, static_cast<std::uint32_t>(kBatch)); }

std::uint32_t bucket(std::uint32_t mesh) {
  return mesh == embree::Intersection::kMiss ? 0 : shadingOrder->bucketOfMesh[mesh];
}

// Counting sort by bucket.
void sortByMaterial(Intersections& found, std::uint32_t count) {
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
