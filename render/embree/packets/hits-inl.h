// Hits on lanes: members of the packet tracers, which have the surfaces (shaders/surfaces/hooks.h).

#include "shaders/surfaces/barycentrics.h"

real3 rayDirection(const Rays& batch, word ray) {
  return {gatherR(batch.direction[0], ray), gatherR(batch.direction[1], ray), gatherR(batch.direction[2], ray)};
}

EFFECT_CONST bool kReadsExtras = kEffectPolarizingElement || kEffectThinGlass || kEffectTextures ||
                                 kEffectMeshTextures || kEffectAbsorption || kEffectCoatings || kEffectRoughness ||
                                 kEffectPolarizedEmitters || kEffectSpecularFactors || kEffectTintedGlass ||
                                 kEffectClearCoats;

// Makes materialExtra return that of a packet's materials. Packets are sorted by material, so that it is often that of
// the packet before.
void loadExtra(word material) {
  if (!kReadsExtras || !anyM(notM(equalW(material, extraOf)))) return;
  extraOf = material;
  gatherRow(scene->extras.data(), material, extra);
}

// row(values): a packet of a row of the batch.
template <class Row>
Ray loadRay(const Rays& batch, Row row) {
  real distance = 0.0f;
#if MALUS_EFFECT_ABSORPTION
  distance = row(batch.originDistance);
#endif
  Ray ray =
      makeRay({row(batch.origin[0]), row(batch.origin[1]), row(batch.origin[2])},
              {row(batch.direction[0]), row(batch.direction[1]), row(batch.direction[2])}, row(batch.depth), distance);
#if MALUS_PATH_WORD
  ray.path = floatBits(row(reinterpret_cast<const float*>(batch.path)));  // moved, not computed with
#endif
  return ray;
}

// Rays of a batch by their indices.
Ray loadRay(const Rays& batch, word ray) {
  if (!isSuccessive(ray)) return loadRay(batch, [&](const float* values) HWY_ATTR { return gatherR(values, ray); });
  const std::uint32_t first = firstLane(ray);
  return loadRay(batch, [&](const float* values) HWY_ATTR { return loadR(values + first); });
}

MeshRow meshRow(word mesh) { return gatherRow<MeshRow>(scene->meshes.data(), mesh); }
const gpu::Mesh& meshRow(std::uint32_t mesh) { return scene->meshes[mesh]; }

// Triangles that rays meet, and what their meshes have.
struct Triangles {
  real3 p0, p1, p2;  // corners, relative to the mesh's origin
  real3 n0, n1, n2;  // their normals
  mask smooth;       // the mesh has normals; otherwise they are not set
  real3 origin;
#if MALUS_EFFECT_INSTANCES
  real3 error;  // PlacedTriangle::error
#endif
  word material;
#if MALUS_EFFECT_MESH_TEXTURES
  TexturedTriangle corners;        // if the scene has mesh textures
  word vertex0, vertex1, vertex2;  // the same
#endif
};

#if MALUS_EFFECT_MESH_TEXTURES
// A vertex's row of an array of four numbers.
void gatherVertex(const std::vector<glm::vec4>& rows, word vertex, real* values) {
  const word at = timesW(vertex, 4);
  for (int i = 0; i < 4; ++i) values[i] = gatherR(&rows.data()->x + i, at);
}
void gatherVertex(const std::vector<glm::vec4>& rows, std::uint32_t vertex, real* values) {
  for (int i = 0; i < 4; ++i) values[i] = rows[vertex][i];
}
template <class Index>
TexturePoint gatherTexturePoint(Index vertex) {
  real t[4];
  gatherVertex(scene->textureCoordinates, vertex, t);
  return {t[0], t[1], t[2], t[3]};
}
// Tangent of a vertex, weighted.
template <class Index>
void addTangent(Index vertex, real weight, TexturedTriangle& t) {
  real tangent[4];
  gatherVertex(scene->tangents, vertex, tangent);
  t.tangent = t.tangent + real3(tangent[0], tangent[1], tangent[2]) * weight;
  t.handedness = t.handedness + tangent[3] * weight;
}
#endif

#if MALUS_EFFECT_INSTANCES
// Exchanges the corners of triangles that are mirrored.
void exchangeMirrored(word mesh, word& c1, word& c2) {
  constexpr auto kRow = static_cast<std::uint32_t>(kFields<MeshTransform>);
  const auto* kinds = reinterpret_cast<const std::uint32_t*>(scene->meshTransforms.data()) + (kRow - 1);
  const mask isMirrored = equalW(gatherW(kinds, timesW(mesh, kRow)), kMirrored);
  const word first = selectW(isMirrored, c2, c1);
  c2 = selectW(isMirrored, c1, c2);
  c1 = first;
}
void exchangeMirrored(std::uint32_t mesh, std::uint32_t& c1, std::uint32_t& c2) {
  if (scene->meshTransforms[mesh].kind != kMirrored) return;
  const std::uint32_t first = c2;
  c2 = c1;
  c1 = first;
}
#endif

// Index: word, or std::uint32_t if all lanes meet the same triangle.
template <class Index>
void gatherTriangles(Index mesh, Index triangle, Triangles& t) {
  const auto& row = meshRow(mesh);
  Index c0, c1, c2;
  gather3W(&scene->triangles.data()->x, timesW(addW(row.firstTriangle, triangle), 3), c0, c1, c2);
#if MALUS_EFFECT_INSTANCES
  if (bvh->hasInstances()) exchangeMirrored(mesh, c1, c2);
#endif
#if MALUS_EFFECT_MESH_TEXTURES
  if (hasMeshTextures()) {
    t.corners.t0 = gatherTexturePoint(addW(row.firstVertex, c0));
    t.corners.t1 = gatherTexturePoint(addW(row.firstVertex, c1));
    t.corners.t2 = gatherTexturePoint(addW(row.firstVertex, c2));
    t.vertex0 = addW(row.firstVertex, c0), t.vertex1 = addW(row.firstVertex, c1);
    t.vertex2 = addW(row.firstVertex, c2);
  }
#endif
  c0 = timesW(addW(row.firstVertex, c0), 3);
  c1 = timesW(addW(row.firstVertex, c1), 3);
  c2 = timesW(addW(row.firstVertex, c2), 3);
  const float* p = &scene->positions.data()->x;
  t.p0 = gather3(p, c0), t.p1 = gather3(p, c1), t.p2 = gather3(p, c2);
#if MALUS_EFFECT_MESH_TEXTURES
  t.corners.p0 = t.p0, t.corners.p1 = t.p1, t.corners.p2 = t.p2;
#endif
  t.smooth = notM(equalW(row.hasNormals, 0u));
  if (anyM(t.smooth)) {
    const float* n = &scene->normals.data()->x;
    t.n0 = gather3(n, c0), t.n1 = gather3(n, c1), t.n2 = gather3(n, c2);
  }
  t.origin = row.origin;
#if MALUS_EFFECT_INSTANCES
  t.error = splat3(0.0f);
#endif
  t.material = row.material;
}

#if MALUS_EFFECT_MESH_TEXTURES
// Sets the point and the tangent of the triangles, without curvature.
void setTexture(const Barycentrics& b, Triangles& t) {
  t.corners.b1 = b.b1, t.corners.b2 = b.b2;
  t.corners.curvature = 0.0f;
  t.corners.tangent = splat3(0.0f);
  t.corners.handedness = 0.0f;
  if (scene->tangents.size() != scene->positions.size()) return;
  addTangent(t.vertex0, real(1.0f) - b.b1 - b.b2, t.corners);
  addTangent(t.vertex1, b.b1, t.corners);
  addTangent(t.vertex2, b.b2, t.corners);
}
#endif

#if MALUS_EFFECT_INSTANCES
// Moves triangles to where their meshes are placed; their normals stay.
void placeTriangles(const MeshTransform& transform, Triangles& t) {
  const PlacedTriangle placed = placeTriangle(transform, t.origin, t.p0, t.p1, t.p2);
  t.p0 = placed.p0, t.p1 = placed.p1, t.p2 = placed.p2;
  t.origin = placed.origin;
  t.error = placed.error;
}
#if MALUS_EFFECT_MESH_TEXTURES
void placeTextures(const MeshTransform& transform, Triangles& t) {
  const PlacedTriangle placed = {t.p0, t.p1, t.p2, t.origin, t.error};
  t.corners = placeTexture(transform, placed, t.corners);
  if (anyM(t.smooth))
    t.corners.curvature = selectR(t.smooth, placedCurvature(transform, placed, t.n0, t.n1, t.n2), 0.0f);
}
#endif
#endif

// The normals of smooth meshes, else 0.
static real3 interpolatedNormal(const Triangles& t, const Barycentrics& b) {
  const real3 none = splat3(0.0f);
  if (!anyM(t.smooth)) return none;
  const real b0 = real(1.0f) - b.b1 - b.b2;
  return select3(t.smooth, t.n0 * b0 + t.n1 * b.b1 + t.n2 * b.b2, none);
}

// The hits of rays that meet a surface. Neighbouring rays mostly meet the same triangle.
Hit gatherHit(const Rays& batch, const Intersections& found, word ray) {
  return gatherHit(loadRay(batch, ray), gatherW(found.mesh, ray), gatherW(found.triangle, ray));
}
Hit gatherHit(const Ray& traced, word mesh, word triangle) {
  Triangles t;
  if (sameInAll(mesh) && sameInAll(triangle))
    gatherTriangles(firstLane(mesh), firstLane(triangle), t);
  else
    gatherTriangles(mesh, triangle, t);
#if MALUS_EFFECT_INSTANCES
  MeshTransform transform;
  if (bvh->hasInstances()) {
    gatherRow(scene->meshTransforms.data(), mesh, transform);
    placeTriangles(transform, t);
  }
#endif
  const Barycentrics b = barycentricCoordinates(traced.origin - t.origin, traced.d, t.p0, t.p1, t.p2);
  real3 interpolated = interpolatedNormal(t, b);
#if MALUS_EFFECT_INSTANCES
  if (bvh->hasInstances() && anyM(t.smooth)) interpolated = placeNormal(transform, interpolated);
#endif
#if MALUS_EFFECT_MESH_TEXTURES
  TextureHit texture;
  RayCone cone;
  if (hasMeshTextures()) {
    setTexture(b, t);
    if (anyM(t.smooth))
      t.corners.curvature = selectR(t.smooth, triangleCurvature(t.p0, t.p1, t.p2, t.n0, t.n1, t.n2), 0.0f);
#if MALUS_EFFECT_INSTANCES
    if (bvh->hasInstances()) placeTextures(transform, t);
#endif
    texture = textureHitAt(traced, t.origin, t.corners, cone);
    interpolated = normalAt(t.material, texture, t.corners, interpolated);
  }
#endif
#if MALUS_EFFECT_INSTANCES
  Hit h = makePlacedHit(traced, t.p0, t.p1, t.p2, b.b1, b.b2, t.origin, interpolated, t.material, t.error);
#else
  Hit h = makeHit(traced, t.p0, t.p1, t.p2, b.b1, b.b2, t.origin, interpolated, t.material);
#endif
#if MALUS_EFFECT_MESH_TEXTURES
  if (hasMeshTextures()) setTextureHit(h, texture, t.corners, cone);
#endif
  return h;
}

// Finds the nearest surface along a ray toward a light.
mask findShadowHit(mask needed, const Ray& ray, Hit& hit) {
  needed = andM(needed, active);
  hit = environmentHit(ray.d, ray.depth);
  if (!anyM(needed)) return needed;
  embree::RayHitPacket<kLanes>& query = nearestQuery;
  HWY_ALIGN_MAX std::uint32_t valid[kLanes];
  hn::Store(selectW(needed, ~0u, 0u).v, Words(), valid);
  storeR(ray.origin.x, query.ray.org_x), storeR(ray.d.x, query.ray.dir_x);
  storeR(ray.origin.y, query.ray.org_y), storeR(ray.d.y, query.ray.dir_y);
  storeR(ray.origin.z, query.ray.org_z), storeR(ray.d.z, query.ray.dir_z);
  embree::initializeHit(query);
  bvh->nearest(reinterpret_cast<const int*>(valid), query, false);
  rays += countM(needed);
  const mask found = andM(needed, notM(equalW(loadW(query.hit.geomID), embree::Intersection::kMiss)));
  if (!anyM(found)) return found;
  // The other lanes get the first triangle of the scene.
  hit = gatherHit(ray, selectW(found, foundMesh(), 0u), selectW(found, loadW(query.hit.primID), 0u));
  loadExtra(hit.material);
  return found;
}
void endShadowHits(const Hit& hit) { loadExtra(hit.material); }

// Adds the chosen lanes to a batch and returns the index of the first; the others follow.
std::uint32_t addRays(Rays& batch, mask chosen, const Ray& ray) {
  const std::uint32_t at = batch.count;
  const ChosenLanes lanes(chosen);
  lanes.store(ray.origin.x, batch.origin[0] + at);
  lanes.store(ray.origin.y, batch.origin[1] + at);
  lanes.store(ray.origin.z, batch.origin[2] + at);
  lanes.store(ray.d.x, batch.direction[0] + at);
  lanes.store(ray.d.y, batch.direction[1] + at);
  lanes.store(ray.d.z, batch.direction[2] + at);
  lanes.store(ray.depth, batch.depth + at);
#if MALUS_EFFECT_ABSORPTION
  lanes.store(ray.originDistance, batch.originDistance + at);
#endif
#if MALUS_PATH_WORD
  lanes.store(ray.path, batch.path + at);
#endif
  batch.count = at + static_cast<std::uint32_t>(countM(chosen));
  return at;
}

// The camera's rays through one sample of each pixel of a tile, in rows. column, row: of the sample in its pixel.
void cameraRays(const embree::TileInput& tile, std::uint32_t column, std::uint32_t row, Rays& batch) {
  const std::uint32_t width = tile.endX - tile.beginX;
  batch.count = width * (tile.endY - tile.beginY);
  std::uint32_t pixelX = 0, pixelY = 0;
  for (std::uint32_t at = 0; at < batch.count; at += static_cast<std::uint32_t>(kLanes)) {
    HWY_ALIGN float x[kLanes], y[kLanes];
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      x[i] = static_cast<float>((tile.beginX + camera.regionX + pixelX) * camera.samples + column);
      y[i] = static_cast<float>((tile.beginY + camera.regionY + pixelY) * camera.samples + row);
      if (++pixelX == width) pixelX = 0, ++pixelY;
    }
    const real3 d = sampleDirection(loadR(x), loadR(y)), from = sampleOrigin(loadR(x), loadR(y));
    storeR(from.x, batch.origin[0] + at), storeR(d.x, batch.direction[0] + at);
    storeR(from.y, batch.origin[1] + at), storeR(d.y, batch.direction[1] + at);
    storeR(from.z, batch.origin[2] + at), storeR(d.z, batch.direction[2] + at);
    storeR(real(camera.depth), batch.depth + at);
#if MALUS_EFFECT_ABSORPTION
    storeR(0.0f, batch.originDistance + at);
#endif
#if MALUS_PATH_WORD
    hn::StoreU(pathStart(wordOfReal(loadR(x)), wordOfReal(loadR(y))).v, Words(), batch.path + at);
#endif
  }
}

// Stores kGroup channels from `first` on next to each other, for each lane.
template <std::size_t kGroup>
static void storeInterleaved(const real3* values, std::size_t first, float* to) {
  const auto channel = [&](std::size_t i) HWY_ATTR { return getField(values[(first + i) / 3], (first + i) % 3).v; };
  if constexpr (kGroup == 3)
    hn::StoreInterleaved3(channel(0), channel(1), channel(2), Floats(), to);
  else
    hn::StoreInterleaved4(channel(0), channel(1), channel(2), channel(3), Floats(), to);
}

// Writes kChannels floats per pixel, three per value, for the pixels of a tile from index `at` on.
template <std::size_t kChannels>
static void writePixels(const embree::TileInput& tile, std::uint32_t at, const real3* values) {
  const std::uint32_t width = tile.endX - tile.beginX;
  const std::uint32_t count = width * (tile.endY - tile.beginY);
  std::uint32_t x = at % width, y = at / width;
  float* pixel = tile.pixels + (std::size_t{tile.beginY + y} * tile.camera->regionWidth + tile.beginX + x) * kChannels;
  if (kChannels == 3 && x + kLanes <= width) {
    hn::StoreInterleaved3(values->x.v, values->y.v, values->z.v, Floats(), pixel);
    return;
  }
  // Channels are written by fours where there are as many; the last four may repeat some of those before.
  constexpr std::size_t kGroup = kChannels < 4 ? 3 : 4;
  constexpr std::size_t kGroups = (kChannels + kGroup - 1) / kGroup;
  const auto first = [](std::size_t group) { return std::min(group * kGroup, kChannels - kGroup); };
  HWY_ALIGN_MAX float lanes[kGroups][kLanes * kGroup];
  for (std::size_t i = 0; i < kGroups; ++i) storeInterleaved<kGroup>(values, first(i), lanes[i]);
  for (std::uint32_t lane = 0; lane < kLanes && at + lane < count; ++lane) {
    for (std::size_t i = 0; i < kGroups; ++i)
      std::memcpy(pixel + first(i), lanes[i] + kGroup * lane, kGroup * sizeof(float));
    pixel += kChannels;
    if (++x < width) continue;
    x = 0;
    pixel += std::size_t{tile.camera->regionWidth - width} * kChannels;
  }
}
