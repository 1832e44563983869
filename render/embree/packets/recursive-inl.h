// Driver of the recursive methods on packets, as members of a tracer. A batch of rays is traced and shaded together;
// the rays that its surfaces send make the next batch, and the payloads that return are combined in the order of
// shaders/surfaces/shade.h by the same steps. Included once per instruction set; no include guard.

// Packets do not check numerics.
real3 roundingSlack(const Stokes&) { return splat3(0.0f); }
void checkSent(const Hit&, const Payload&, const real3&) {}

#include "shaders/surfaces/sent_light.h"
#include "shaders/surfaces/shade_environment.h"
#include "shaders/surfaces/shade_sources.h"

// Surfaces whose rays have not all returned.
struct PendingPacket {
  Hit h;
  Scattering s;
  SurfaceLight toCamera;
  real3 sDir;
  real3 highlight;
  VisibleFacets visible;
  Facet facet;    // the one that is followed
  mask active;    // lanes that have a ray
  mask reflects;  // lanes that follow the reflected ray, the facets, the transmitted ray
  mask rough;
  mask transmits;
  mask follows;        // lanes whose ray is on its way
  word ray;            // index of the ray that hit the surface
  std::uint32_t sent;  // index of the first ray that is on its way; the others follow
};

// Payloads by the index of their ray, a row per field.
struct Payloads {
  HWY_ALIGN_MAX float field[kFields<Payload>][kBatch + kLanes];
};

// State of one level of the recursion while the next one works. Each kind of surface may leave one packet not full.
struct Level {
  Intersections found;
  PendingPacket pending[kBatch / kLanes + gpu::kSurfaceKinds];
  std::size_t pendingCount;
  Rays rays;          // to the next level
  Payloads returned;  // from it
};
Level* levels[embree::kMostLevels] = {};

void storePayload(const Payload& payload, Payloads& to, word ray) {
  if (isSuccessive(ray)) {
    for (std::size_t i = 0; i < kFields<Payload>; ++i) storeR(getField(payload, i), to.field[i] + firstLane(ray));
    return;
  }
  for (std::size_t i = 0; i < kFields<Payload>; ++i) scatterR(getField(payload, i), to.field[i], ray);
}

// The payloads from `first` on, in the chosen lanes.
Payload loadPayload(const Payloads& from, std::uint32_t first, mask chosen) {
  Payload payload;
  if (!anyM(notM(chosen))) {
    for (std::size_t i = 0; i < kFields<Payload>; ++i) setField(payload, i, loadR(from.field[i] + first));
    return payload;
  }
  const Order ranks = rankChosen(chosen);
  for (std::size_t i = 0; i < kFields<Payload>; ++i) setField(payload, i, loadChosen(from.field[i] + first, ranks));
  return payload;
}

// Whether no light returned in the chosen lanes.
static bool isBlack(const Payload& payload, mask chosen) {
  mask black = true;
  for (std::size_t i = 0; i < kFields<Payload>; ++i) black = andM(black, equalW(floatBits(getField(payload, i)), 0u));
  return !anyM(andM(chosen, notM(black)));
}

static void addLight(PendingPacket& p, mask chosen, const SurfaceLight& light) {
  p.toCamera = selectFields(chosen, lightAdd(p.toCamera, light), p.toCamera);
}

// Collects the light that needs no ray but shadow rays, and decides which rays follow.
void meetSurface(std::uint32_t kind, PendingPacket& p) {
  loadExtra(p.h.material);
  const Material m = materialAt(p.h);
  p.active = active;
  ::new (&p.s) Scattering(surfaceScattering(p.h, m, kind));
  p.sDir = surfaceS(p.h.d, p.s.frameNormal);
  DirectLight direct = noDirectLight();
  if (anyM(p.s.reflects)) direct = directLight(p.h, m, p.s.reflected);
  p.toCamera = lightUnpolarized(splat3(0.0f));
  if (hasBase(kind)) p.toCamera = lightFromBelow(p.s.reflection, direct.diffuse);
  p.highlight = direct.highlight;
  const mask scatters = andM(canScatter(p.h), active);
  p.reflects = andM(scatters, p.s.reflects);
  p.transmits = andM(scatters, p.s.transmits);
  p.rough = false;
  if (kEffectRoughness) {
    if (hasBase(kind)) p.rough = andM(p.reflects, isRough(p.h));
    if (anyM(p.rough)) {
      p.reflects = andM(p.reflects, notM(p.rough));
      addLight(p, p.rough, lightThroughInterface(p.s.reflection, lightUnpolarized(p.highlight)));
      ::new (&p.visible) VisibleFacets(visibleFacetsAt(p.h));
    }
  }
}

// Sends the rays of every pending packet that `choose` gives (packet, origin, direction, depth) for the lanes in
// packet.follows, traces them, and calls combine(packet, payload) for the packets that sent any.
template <class Choose, class Combine>
void followRays(std::size_t depth, Level& level, Choose choose, Combine combine) {
  level.rays.count = 0;
  for (std::size_t i = 0; i < level.pendingCount; ++i) {
    PendingPacket& p = level.pending[i];
    choose(p);
  }
  if (level.rays.count == 0) return;
  traceRays(depth + 1, level.rays, level.returned);
  for (std::size_t i = 0; i < level.pendingCount; ++i) {
    PendingPacket& p = level.pending[i];
    if (anyM(p.follows)) combine(p, loadPayload(level.returned, p.sent, p.follows));
  }
}

void followReflections(std::size_t depth, Level& level) {
  followRays(
      depth, level,
      [&](PendingPacket& p) HWY_ATTR {
        p.follows = p.reflects;
        if (anyM(p.follows)) p.sent = addRays(level.rays, p.follows, rayAbove(p.h, p.s.reflected, p.h.depth - 1.0f));
      },
      [&](PendingPacket& p, const Payload& returned) HWY_ATTR {
        real3 slack;
        const SurfaceLight arriving = returnedLight(returned, p.s.reflected, p.sDir, slack);
        addLight(p, p.follows,
                 lightThroughInterface(p.s.reflection, lightAdd(arriving, lightUnpolarized(p.highlight))));
      });
}

void followTransmissions(std::size_t depth, Level& level) {
  followRays(
      depth, level,
      [&](PendingPacket& p) HWY_ATTR {
        p.follows = p.transmits;
        if (anyM(p.follows)) p.sent = addRays(level.rays, p.follows, rayBelow(p.h, p.s.transmitted, p.h.depth - 1.0f));
      },
      [&](PendingPacket& p, const Payload& returned) HWY_ATTR {
        real3 slack;
        const SurfaceLight arriving = returnedLight(returned, p.s.transmitted, p.sDir, slack);
        addLight(p, p.follows, lightThroughInterface(p.s.transmission, arriving));
      });
}

void followFacets(std::size_t depth, Level& level) {
  for (std::uint32_t i = 0; i < gpu::kFacets; ++i)
    followRays(
        depth, level,
        [&](PendingPacket& p) HWY_ATTR {
          p.follows = p.rough;
          if (!anyM(p.follows)) return;
          loadExtra(p.h.material);
          p.facet = sampleFacet(p.h, p.visible, camera.facets[i].x, camera.facets[i].y);
          p.follows = andM(p.rough, lessR(0.0f, p.facet.weight));
          if (anyM(p.follows)) p.sent = addRays(level.rays, p.follows, facetRay(p.h, p.facet, i));
        },
        [&](PendingPacket& p, const Payload& returned) HWY_ATTR {
          if (isBlack(returned, p.follows)) return;
          real3 slack;
          loadExtra(p.h.material);
          addLight(p, p.follows, facetLight(p.h, materialAt(p.h), p.facet, returned, p.sDir, slack));
        });
}

// The light that returns along a batch of rays. depth: of the recursion.
void traceRays(std::size_t depth, const Rays& batch, Payloads& light) {
  if (levels[depth] == nullptr) levels[depth] = new Level;
  Level& level = *levels[depth];
  intersect(batch, level.found);
  level.pendingCount = 0;
  forEachPacket(
      level.found,
      [&](word ray) HWY_ATTR {
        storePayload(shadeEnvironment(rayDirection(batch, ray), gatherR(batch.depth, ray)), light, parked(ray));
      },
      [&](std::uint32_t kind, word ray) HWY_ATTR {
        PendingPacket& p = level.pending[level.pendingCount];
        ::new (&p.h) Hit(gatherHit(batch, level.found, ray));
        if (isSource(kind)) {
          loadExtra(p.h.material);
          storePayload(shadeSource(p.h, materialAt(p.h), kind), light, parked(ray));
          return;
        }
        p.ray = parked(ray);
        meetSurface(kind, p);
        ++level.pendingCount;
      });
  followReflections(depth, level);
  if (kEffectRoughness) followFacets(depth, level);
  followTransmissions(depth, level);
  for (std::size_t i = 0; i < level.pendingCount; ++i) {
    const PendingPacket& p = level.pending[i];
    if (kEffectAbsorption) loadExtra(p.h.material);
    storePayload(sentPayload(p.toCamera, p.h.d, p.sDir, arrivalTransmittance(p.h)), light, p.ray);
  }
}

// Of the pixels of a tile.
Rays primary;
Payloads primaryLight;
static constexpr bool kPolarized = kFields<SurfaceLight> > 3;  // more than a colour
static constexpr std::size_t kSums = kPolarized ? 12 : 3;      // fields of a Stokes vector that are not 0
HWY_ALIGN_MAX float sums[kSums][kBatch + kLanes];

// Adds the Stokes vectors in the camera frame.
void addSamples() {
  for (std::uint32_t at = 0; at < primary.count; at += static_cast<std::uint32_t>(kLanes)) {
    const word pixel = addW(hn::Iota(Words(), 0), at);
    const real3 d = rayDirection(primary, pixel);
    Stokes s = payloadStokes(loadPayload(primaryLight, at, true), d);
    if (kPolarized) {
      real cos2;
      real sin2;
      cameraFrameRotation(d, camera.up, cos2, sin2);
      s = rotateStokes(s, cos2, sin2);
    }
    for (std::size_t i = 0; i < kSums; ++i) storeR(loadR(sums[i] + at) + getField(s, i), sums[i] + at);
  }
}

Stokes pixelStokes(std::uint32_t at) {
  Stokes s = stokesUnpolarized(splat3(0.0f));
  const real scale = camera.basicToRadiance / static_cast<float>(camera.samples * camera.samples);
  for (std::size_t i = 0; i < kSums; ++i) setField(s, i, loadR(sums[i] + at) * scale);
  return s;
}

void renderTile(const embree::TileInput& tile) {
  std::memset(sums, 0, sizeof sums);
  for (std::uint32_t j = 0; j < camera.samples; ++j)
    for (std::uint32_t i = 0; i < camera.samples; ++i) {
      cameraRays(tile, i, j, primary);
      traceRays(0, primary, primaryLight);
      addSamples();
    }
  for (std::uint32_t at = 0; at < primary.count; at += static_cast<std::uint32_t>(kLanes)) {
    const Stokes s = pixelStokes(at);
    const real3 values[5] = {cameraColour(s), s.s0, s.s1, s.s2, s.s3};
    writePixels<kHasStokes != 0 ? gpu::kStokesChannels : gpu::kColourChannels>(tile, at, values);
  }
}

void freeLevels() {
  for (Level* level : levels) delete level;
}
