// Hits on lanes: members of the packet tracers, which have the surfaces (shaders/surfaces/hooks.h).

#include "shaders/surfaces/barycentrics.h"

real3 rayDirection(const Rays& batch, word ray) {
  return {gatherR(batch.direction[0], ray), gatherR(batch.direction[1], ray), gatherR(batch.direction[2], ray)};
}

static constexpr bool kReadsExtras = kEffectPolarizingElement || kEffectThinGlass || kEffectTextures ||
                                     kEffectAbsorption || kEffectCoatings || kEffectRoughness ||
                                     kEffectPolarizedEmitters;

// Makes materialExtra return that of a packet's materials.
void loadExtra(word material) {
  if (kReadsExtras) extra = gatherRow<MaterialExtra>(scene->extras.data(), material);
}

// row(values): a packet of a row of the batch.
template <class Row>
Ray loadRay(const Rays& batch, Row row) {
  real distance = 0.0f;
#if MALUS_EFFECT_ABSORPTION
  distance = row(batch.originDistance);
#endif
  return makeRay({row(batch.origin[0]), row(batch.origin[1]), row(batch.origin[2])},
                 {row(batch.direction[0]), row(batch.direction[1]), row(batch.direction[2])}, row(batch.depth),
                 distance);
}

// Rays of a batch by their indices.
Ray loadRay(const Rays& batch, word ray) {
  if (!isSuccessive(ray)) return loadRay(batch, [&](const float* values) HWY_ATTR { return gatherR(values, ray); });
  const std::uint32_t first = firstLane(ray);
  return loadRay(batch, [&](const float* values) HWY_ATTR { return loadR(values + first); });
}

// The hits of rays that meet a surface.
Hit gatherHit(const Rays& batch, const Intersections& found, word ray) {
  const Ray traced = loadRay(batch, ray);
  const MeshRow mesh = gatherRow<MeshRow>(scene->meshes.data(), gatherW(found.mesh, ray));
  const word corners = timesW(addW(mesh.firstTriangle, gatherW(found.triangle, ray)), 3);
  const std::uint32_t* triangles = &scene->triangles.data()->x;
  const word c0 = timesW(addW(mesh.firstVertex, gatherW(triangles, corners)), 3);
  const word c1 = timesW(addW(mesh.firstVertex, gatherW(triangles + 1, corners)), 3);
  const word c2 = timesW(addW(mesh.firstVertex, gatherW(triangles + 2, corners)), 3);
  const float* p = &scene->positions.data()->x;
  const real3 p0 = gather3(p, c0), p1 = gather3(p, c1), p2 = gather3(p, c2);
  const Barycentrics b = barycentricCoordinates(traced.origin - mesh.origin, traced.d, p0, p1, p2);
  real3 interpolated = splat3(0.0f);
  const mask smooth = notM(equalW(mesh.hasNormals, 0u));
  if (anyM(smooth)) {
    const float* n = &scene->normals.data()->x;
    const real b0 = real(1.0f) - b.b1 - b.b2;
    interpolated = select3(smooth, gather3(n, c0) * b0 + gather3(n, c1) * b.b1 + gather3(n, c2) * b.b2, interpolated);
  }
  return makeHit(traced, p0, p1, p2, b.b1, b.b2, mesh.origin, interpolated, mesh.material);
}

// Adds the chosen lanes to a batch and returns the index of the first; the others follow.
std::uint32_t addRays(Rays& batch, mask chosen, const Ray& ray) {
  const std::uint32_t at = batch.count;
  storeChosen(ray.origin.x, chosen, batch.origin[0] + at);
  storeChosen(ray.origin.y, chosen, batch.origin[1] + at);
  storeChosen(ray.origin.z, chosen, batch.origin[2] + at);
  storeChosen(ray.d.x, chosen, batch.direction[0] + at);
  storeChosen(ray.d.y, chosen, batch.direction[1] + at);
  storeChosen(ray.d.z, chosen, batch.direction[2] + at);
  storeChosen(ray.depth, chosen, batch.depth + at);
#if MALUS_EFFECT_ABSORPTION
  storeChosen(ray.originDistance, chosen, batch.originDistance + at);
#endif
  batch.count = at + static_cast<std::uint32_t>(countM(chosen));
  return at;
}

// The camera's rays through one sample of each pixel of a tile, in rows. column, row: of the sample in its pixel.
void cameraRays(const embree::TileInput& tile, std::uint32_t column, std::uint32_t row, Rays& batch) {
  const std::uint32_t width = tile.endX - tile.beginX;
  batch.count = width * (tile.endY - tile.beginY);
  const real3 from(camera.position);
  for (std::uint32_t at = 0; at < batch.count; at += static_cast<std::uint32_t>(kLanes)) {
    HWY_ALIGN float x[kLanes], y[kLanes];
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      const std::uint32_t pixel = at + i;
      x[i] = static_cast<float>((tile.beginX + camera.regionX + pixel % width) * camera.samples + column);
      y[i] = static_cast<float>((tile.beginY + camera.regionY + pixel / width) * camera.samples + row);
    }
    const real3 d = sampleDirection(loadR(x), loadR(y));
    storeR(from.x, batch.origin[0] + at), storeR(d.x, batch.direction[0] + at);
    storeR(from.y, batch.origin[1] + at), storeR(d.y, batch.direction[1] + at);
    storeR(from.z, batch.origin[2] + at), storeR(d.z, batch.direction[2] + at);
    storeR(real(camera.depth), batch.depth + at);
#if MALUS_EFFECT_ABSORPTION
    storeR(0.0f, batch.originDistance + at);
#endif
  }
}

// Writes `channels` floats per pixel for the pixels of a tile from index `at` on.
static void writePixels(const embree::TileInput& tile, std::uint32_t at, const real3* values, std::size_t channels) {
  HWY_ALIGN float lanes[gpu::kStokesChannels][kLanes];
  for (std::size_t i = 0; i < channels; ++i) {
    const real3& v = values[i / 3];
    storeR(i % 3 == 0 ? v.x : i % 3 == 1 ? v.y : v.z, lanes[i]);
  }
  const std::uint32_t width = tile.endX - tile.beginX;
  const std::uint32_t count = width * (tile.endY - tile.beginY);
  for (std::uint32_t lane = 0; lane < kLanes && at + lane < count; ++lane) {
    const std::size_t x = tile.beginX + (at + lane) % width;
    const std::size_t y = tile.beginY + (at + lane) / width;
    float* pixel = tile.pixels + (y * tile.camera->regionWidth + x) * channels;
    for (std::size_t i = 0; i < channels; ++i) pixel[i] = lanes[i][lane];
  }
}
