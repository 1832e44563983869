// Driver of the iterative methods on packets, as members of a tracer: the paths of a batch are followed together by the
// steps of shaders/iterative/camera_path.h, and the paths that go on make the next batch. Included once per instruction
// set; no include guard.

#include "shaders/iterative/path.h"
#include "shaders/iterative/path_light.h"

// The part of a path's throughput that is needed where it meets something.
enum class Need : std::uint32_t { kNothing, kUnpolarized, kAll };

// Rays with the throughput of their paths, a row per field, and the pixel of each in the tile.
struct Paths {
  Rays rays;
  HWY_ALIGN_MAX float throughput[kFields<Throughput>][kBatch + kLanes];
  HWY_ALIGN_MAX std::uint32_t pixel[kBatch + kLanes];
};

// Rough surfaces whose facets are followed after the other paths.
struct RoughPacket {
  Hit h;
  Material m;
  Throughput throughput;
  mask coloured;  // the facets' terms may differ between colours
  mask rough;
  word pixel;
  VisibleFacets visible;
  Facet facet;         // the one that is followed
  mask follows;        // lanes whose ray is on its way
  std::uint32_t sent;  // index of the first such ray; the others follow
};

// State of one level while the next one works. At most one ray of each kind leaves per path, so that each fits.
struct Level {
  Intersections found;
  Paths reflected;  // also those of one facet each
  Paths transmitted;
  RoughPacket rough[MALUS_EFFECT_ROUGHNESS ? kBatch / kLanes + gpu::kSurfaceKinds : 1];
  std::size_t roughCount;
};
Level* levels[embree::kMostLevels] = {};
HWY_ALIGN_MAX float sums[3][kBatch + kLanes];  // radiance that the camera records, by pixel
real threshold;                                // paths with a smaller throughput end
std::vector<std::uint32_t> needOfBucket;       // Need where a ray's hit is in a bucket (embree::ShadingOrder)

// Fields of colours that share the first vector are not stored. polarized: the light there is; without it only the
// fields that it needs are read, and the others are 0.
Throughput loadThroughput(const Paths& paths, word path, bool polarized) {
  Throughput c;
  for (std::size_t i = 0; !polarized && i < kFields<Throughput>; ++i) setField(c, i, real(0.0f));
  const auto load = [&](std::size_t begin, std::size_t end, auto row) HWY_ATTR {
    for (std::size_t i = begin; i < end; ++i)
      if (polarized || (kUnpolarizedFields >> i & 1u) != 0) setField(c, i, row(paths.throughput[i]));
  };
  const auto loadAll = [&](auto row) HWY_ATTR {
    load(0, kSharedFields, row);
    if (kSharedFields < kFields<Throughput> && anyM(isSplit(c))) load(kSharedFields, kFields<Throughput>, row);
  };
  if (isSuccessive(path))
    loadAll([&](const float* values) HWY_ATTR { return loadR(values + firstLane(path)); });
  else
    loadAll([&](const float* values) HWY_ATTR { return gatherR(values, path); });
  return c;
}

// Stores the needed part of a throughput in the chosen lanes, from path `at` on.
template <Need kNeed>
static void storeThroughput(const Throughput& c, mask chosen, Paths& paths, std::uint32_t at) {
  const ChosenLanes lanes(chosen);
  const auto store = [&](std::size_t begin, std::size_t end) HWY_ATTR {
    for (std::size_t i = begin; i < end; ++i)
      if (kNeed == Need::kAll || (kUnpolarizedFields >> i & 1u) != 0)
        lanes.store(getField(c, i), paths.throughput[i] + at);
  };
  store(0, kSharedFields);
  if (kSharedFields < kFields<Throughput> && anyM(andM(chosen, isSplit(c)))) store(kSharedFields, kFields<Throughput>);
}

void addPaths(Paths& paths, mask chosen, const CameraPath& p, word pixel) {
  chosen = andM(chosen, active);
  if (!anyM(chosen)) return;
  const std::uint32_t at = paths.rays.count;
  storeThroughput<Need::kAll>(p.throughput, chosen, paths, at);
  ChosenLanes(chosen).store(pixel, paths.pixel + at);
  addRays(paths.rays, chosen, p.ray);
}

// Adds light to the pixels of the active lanes. Each pixel has one path in a batch.
void record(const real3& light, word pixel) {
  if (isSuccessive(pixel)) {  // and all lanes are active
    const std::uint32_t at = firstLane(pixel);
    storeR(loadR(sums[0] + at) + light.x, sums[0] + at);
    storeR(loadR(sums[1] + at) + light.y, sums[1] + at);
    storeR(loadR(sums[2] + at) + light.z, sums[2] + at);
    return;
  }
  pixel = parked(pixel);
  scatterR(gatherR(sums[0], pixel) + light.x, sums[0], pixel);
  scatterR(gatherR(sums[1], pixel) + light.y, sums[1], pixel);
  scatterR(gatherR(sums[2], pixel) + light.z, sums[2], pixel);
}

void addRough(const Hit& h, const Material& m, const Scattering& s, const Throughput& c, mask rough, word pixel,
              Level& level) {
  RoughPacket& r = level.rough[level.roughCount++];
  ::new (&r) RoughPacket{h, m, c, s.coloured, rough, pixel, visibleFacetsAt(h), {}, {}, 0};
}

// Rays that leave a surface, and the light that it adds to the paths that met it.
void meetSurface(std::uint32_t kind, Hit& h, CameraPath& p, word pixel, Level& level) {
  const Material m = materialAt(h);
  if (kEffectAbsorption) scaleThroughput(p.throughput, mediumTransmittance(h));
  if (isSource(kind)) {
    record(sourceLight(h, m, kind, p.throughput).recorded, pixel);
    return;
  }
  const mask scatters = andM(active, lessR(0.5f, h.depth));
  if (!hasBase(kind) && !anyM(scatters)) return;
  const Scattering s = surfaceScattering(h, m, kind);
  rotateToSurface(p.throughput, h.d, s.frameNormal);
  DirectLight direct = noDirectLight();
  if (anyM(s.reflects)) direct = directLight(h, m, s.reflected);
  real3 light = splat3(0.0f);
  if (hasBase(kind)) light = diffuseExit(p.throughput, s.reflection, direct.diffuse);
  const mask transmits = andM(scatters, s.transmits);
  if (anyM(transmits)) {
    CameraPath through;
    through.throughput = p.throughput;
    followTransmission(through, h, s, camera.tolerance);
    addPaths(level.transmitted, andM(transmits, lessR(threshold, maxComponent(through.throughput))), through, pixel);
  }
  const mask reflects = andM(scatters, s.reflects);
  if (anyM(reflects)) {
    mask rough = false;
    if (kEffectRoughness) {
      if (hasBase(kind)) rough = andM(reflects, isRough(h));
      if (anyM(rough)) addRough(h, m, s, p.throughput, rough, pixel, level);
    }
    applyInterface(p.throughput, s.reflection, s.coloured);
    light = light + select3(reflects, unpolarizedContribution(p.throughput, direct.highlight), splat3(0.0f));
    followReflection(p, h, s, camera.tolerance);
    const mask goesOn = andM(reflects, notM(rough));
    addPaths(level.reflected, andM(goesOn, lessR(threshold, maxComponent(p.throughput))), p, pixel);
  }
  record(light, pixel);
}

// Sends the rays of one facet of each rough surface. A path's throughput behind it is computed where its ray has met
// something, unless paths may end before.
void sendFacetRays(std::uint32_t i, Level& level) {
  Paths& paths = level.reflected;
  paths.rays.count = 0;
  for (std::size_t k = 0; k < level.roughCount; ++k) {
    RoughPacket& r = level.rough[k];
    loadExtra(r.h.material);
    r.facet = sampleFacet(r.h, r.visible, camera.facets[i].x, camera.facets[i].y);
    r.follows = andM(r.rough, lessR(0.0f, r.facet.weight));
    if (anyM(lessR(0.0f, threshold))) {
      const Throughput c = behindFacet(r.throughput, r.h, r.m, r.facet, r.coloured, camera.tolerance);
      r.follows = andM(r.follows, lessR(threshold * (1.0f / static_cast<float>(gpu::kFacets)), maxComponent(c)));
    }
    if (!anyM(r.follows)) continue;
    ChosenLanes(r.follows).store(r.pixel, paths.pixel + paths.rays.count);
    r.sent = addRays(paths.rays, r.follows, facetRay(r.h, r.facet, i));
  }
}

// The most that the paths of the chosen lanes need, by the buckets of their hits.
Need largestNeed(mask chosen, word bucket) const {
  const word need = gatherW(needOfBucket.data(), bucket);
  for (const Need most : {Need::kAll, Need::kUnpolarized})
    if (anyM(andM(chosen, equalW(need, static_cast<std::uint32_t>(most))))) return most;
  return Need::kNothing;
}

Throughput behindFacet(const RoughPacket& r, Need need) {
  if (need == Need::kUnpolarized) return unpolarizedBehindFacet(r.throughput, r.h, r.m, r.facet);
  return behindFacet(r.throughput, r.h, r.m, r.facet, r.coloured, camera.tolerance);
}

// Records the light of the environment that arrives by the facets, and stores what the other paths need of their
// throughput. The rays were traced last.
void arriveByFacet(const RoughPacket& r, Paths& paths) {
  const word bucket = selectW(r.follows, loadChosen(buckets.key + r.sent, rankChosen(r.follows)), 0u);
  const Need need = largestNeed(r.follows, bucket);
  if (need == Need::kNothing) return;
  const mask met = notM(equalW(bucket, 0u));
  const mask missed = andM(r.follows, notM(met));
  loadExtra(r.h.material);
  const Throughput c = behindFacet(r, need);
  if (!isEnvironmentBlack() && anyM(missed)) {
    active = r.rough;
    record(select3(missed, environmentLight(c, r.facet.mirror).recorded, splat3(0.0f)), r.pixel);
  }
  if (!anyM(met)) return;
  if (need == Need::kUnpolarized)
    storeThroughput<Need::kUnpolarized>(c, r.follows, paths, r.sent);
  else
    storeThroughput<Need::kAll>(c, r.follows, paths, r.sent);
}

// Follows the paths of one facet of each rough surface.
void followFacet(std::uint32_t i, std::size_t depth, Level& level) {
  sendFacetRays(i, level);
  Paths& paths = level.reflected;
  if (paths.rays.count == 0) return;
  Level& next = levelAt(depth + 1);
  intersect(paths.rays, next.found);
  for (std::size_t k = 0; k < level.roughCount; ++k) {
    const RoughPacket& r = level.rough[k];
    if (anyM(r.follows)) arriveByFacet(r, paths);
  }
  shadePaths(depth + 1, paths, next, false);
}

void findNeeds() {
  const std::vector<std::uint32_t>& kinds = shadingOrder->kindOfBucket;
  needOfBucket.resize(kinds.size());
  for (std::size_t bucket = 0; bucket < kinds.size(); ++bucket) {
    const bool isPolarized =
        bucket == 0 ? isEnvironmentPolarized() : !isSource(kinds[bucket]) || isSourcePolarized(kinds[bucket]);
    Need need = isPolarized ? Need::kAll : Need::kUnpolarized;
    if (bucket == 0 && isEnvironmentBlack()) need = Need::kNothing;
    needOfBucket[bucket] = static_cast<std::uint32_t>(need);
  }
}

Level& levelAt(std::size_t depth) {
  if (levels[depth] == nullptr) levels[depth] = new Level;
  return *levels[depth];
}

// Follows a batch of paths to their ends. depth: of the recursion.
void followPaths(std::size_t depth, const Paths& paths) {
  if (paths.rays.count == 0) return;
  Level& level = levelAt(depth);
  intersect(paths.rays, level.found);
  shadePaths(depth, paths, level, !isEnvironmentBlack());
}

// The same for a batch whose hits are in `level`. recordsEnvironment: for the rays that leave the scene.
void shadePaths(std::size_t depth, const Paths& paths, Level& level, bool recordsEnvironment) {
  level.reflected.rays.count = level.transmitted.rays.count = 0;
  level.roughCount = 0;
  forEachPacket(
      level.found,
      [&](word path) HWY_ATTR {
        if (!recordsEnvironment) return;
        const real3 d = rayDirection(paths.rays, path);
        const Throughput c = loadThroughput(paths, path, isEnvironmentPolarized());
        record(environmentLight(c, d).recorded, gatherW(paths.pixel, path));
      },
      [&](std::uint32_t kind, word path) HWY_ATTR {
        CameraPath p;
        p.throughput = loadThroughput(paths, path, !isSource(kind) || isSourcePolarized(kind));
        Hit h = gatherHit(paths.rays, level.found, path);
        loadExtra(h.material);
        meetSurface(kind, h, p, gatherW(paths.pixel, path), level);
      });
  followPaths(depth + 1, level.reflected);
  if (kEffectRoughness && level.roughCount > 0)
    for (std::uint32_t i = 0; i < gpu::kFacets; ++i) followFacet(i, depth, level);
  followPaths(depth + 1, level.transmitted);
}

Paths primary;

// Mean over the samples of each pixel of a tile, behind an analyser.
void tracePixels(const embree::TileInput& tile, const glm::vec4& behind) {
  std::memset(sums, 0, sizeof sums);
  threshold = camera.tolerance * behind.x;
  findNeeds();
  for (std::uint32_t j = 0; j < camera.samples; ++j)
    for (std::uint32_t i = 0; i < camera.samples; ++i) {
      cameraRays(tile, i, j, primary.rays);
      for (std::uint32_t at = 0; at < primary.rays.count; at += static_cast<std::uint32_t>(kLanes)) {
        const word path = addW(hn::Iota(Words(), 0), at);
        const Throughput c =
            startThroughput(rayDirection(primary.rays, path), camera.up, behind.x, behind.y, behind.z, behind.w);
        for (std::size_t f = 0; f < kSharedFields; ++f) storeR(getField(c, f), primary.throughput[f] + at);
        hn::StoreU(path.v, Words(), primary.pixel + at);
      }
      followPaths(0, primary);
    }
}

real3 recorded(std::uint32_t at) {
  const real scale = camera.basicToRadiance / static_cast<float>(camera.samples * camera.samples);
  return real3(loadR(sums[0] + at), loadR(sums[1] + at), loadR(sums[2] + at)) * scale;
}

// By four analysers: S0, S0 + S1, S0 + S2, S0 + S3 (shaders/iterative/camera_path.h).
HWY_ALIGN_MAX float analysedSums[4][3][kBatch + kLanes];
void renderStokes(const embree::TileInput& tile) {
  for (std::size_t k = 0; k < 4; ++k) {
    tracePixels(tile, {1, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f, k == 3 ? 1.0f : 0.0f});
    for (std::uint32_t at = 0; at < primary.rays.count; at += static_cast<std::uint32_t>(kLanes)) {
      const real3 light = recorded(at);
      storeR(light.x, analysedSums[k][0] + at);
      storeR(light.y, analysedSums[k][1] + at);
      storeR(light.z, analysedSums[k][2] + at);
    }
  }
  for (std::uint32_t at = 0; at < primary.rays.count; at += static_cast<std::uint32_t>(kLanes)) {
    const auto light = [&](std::size_t k) HWY_ATTR {
      return real3(loadR(analysedSums[k][0] + at), loadR(analysedSums[k][1] + at), loadR(analysedSums[k][2] + at));
    };
    Stokes s;
    s.s0 = light(0);
    s.s1 = light(1) - s.s0;
    s.s2 = light(2) - s.s0;
    s.s3 = light(3) - s.s0;
    const real3 values[5] = {cameraColour(s), s.s0, s.s1, s.s2, s.s3};
    writePixels<gpu::kStokesChannels>(tile, at, values);
  }
}

void renderTile(const embree::TileInput& tile) {
  if (tile.stokes) {
    renderStokes(tile);
    return;
  }
  tracePixels(tile, camera.analyser);
  for (std::uint32_t at = 0; at < primary.rays.count; at += static_cast<std::uint32_t>(kLanes)) {
    const real3 colour = recorded(at);
    writePixels<gpu::kColourChannels>(tile, at, &colour);
  }
}

void freeLevels() {
  for (Level* level : levels) delete level;
}
