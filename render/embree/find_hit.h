// Hooks of shaders/surfaces/hooks.h that trace rays and note faults: members of both kinds of tracer, included inside
// them.

#include "shaders/surfaces/barycentrics.h"

#if MALUS_EFFECT_MESH_TEXTURES
// corner: indices of the triangle's vertices in the mesh.
TexturedTriangle texturedTriangle(const Mesh& mesh, const glm::uvec3& corner, const Barycentrics& b) const {
  const real3* p = scene.positions.data() + mesh.firstVertex;
  const real3* n = scene.normals.data() + mesh.firstVertex;
  const glm::vec4* c = scene.textureCoordinates.data() + mesh.firstVertex;
  const auto point = [c](uint i) { return TexturePoint{c[i].x, c[i].y, c[i].z, c[i].w}; };
  TexturedTriangle t{p[corner.x],
                     p[corner.y],
                     p[corner.z],
                     point(corner.x),
                     point(corner.y),
                     point(corner.z),
                     b.b1,
                     b.b2,
                     real3(0),
                     1,
                     0};
  if (mesh.hasNormals != 0) t.curvature = triangleCurvature(t.p0, t.p1, t.p2, n[corner.x], n[corner.y], n[corner.z]);
  if (scene.tangents.size() == scene.positions.size()) {
    const glm::vec4* tangents = scene.tangents.data() + mesh.firstVertex;
    const glm::vec4 tangent =
        tangents[corner.x] * (1 - b.b1 - b.b2) + tangents[corner.y] * b.b1 + tangents[corner.z] * b.b2;
    t.tangent = real3(tangent);
    t.handedness = tangent.w;
  }
  return t;
}
#endif

#if MALUS_EFFECT_INSTANCES
Hit makeInstanceHit(const Ray& ray, const Mesh& mesh, const MeshTransform& transform, unsigned triangle) {
  glm::uvec3 corner = scene.triangles[mesh.firstTriangle + triangle];
  if (transform.kind == kMirrored) corner = {corner.x, corner.z, corner.y};
  const real3* p = scene.positions.data() + mesh.firstVertex;
  const real3* n = scene.normals.data() + mesh.firstVertex;
  const PlacedTriangle placed = placeTriangle(transform, mesh.origin, p[corner.x], p[corner.y], p[corner.z]);
  const Barycentrics b = barycentricCoordinates(ray.origin - placed.origin, ray.d, placed.p0, placed.p1, placed.p2);
  const real b0 = 1 - b.b1 - b.b2;
  const real3 interpolated = mesh.hasNormals != 0
                                 ? placeNormal(transform, n[corner.x] * b0 + n[corner.y] * b.b1 + n[corner.z] * b.b2)
                                 : real3(0);
#if MALUS_EFFECT_MESH_TEXTURES
  if (hasMeshTextures()) {
    TexturedTriangle t = placeTexture(transform, placed, texturedTriangle(mesh, corner, b));
    if (mesh.hasNormals != 0) t.curvature = placedCurvature(transform, placed, n[corner.x], n[corner.y], n[corner.z]);
    RayCone cone;
    const TextureHit textureHit = textureHitAt(ray, placed.origin, t, cone);
    Hit hit = makePlacedHit(ray, placed.p0, placed.p1, placed.p2, b.b1, b.b2, placed.origin,
                            normalAt(mesh.material, textureHit, t, interpolated), mesh.material, placed.error);
    setTextureHit(hit, textureHit, t, cone);
    return hit;
  }
#endif
  return makePlacedHit(ray, placed.p0, placed.p1, placed.p2, b.b1, b.b2, placed.origin, interpolated, mesh.material,
                       placed.error);
}
#endif

bool findHit(const Ray& ray, Hit& hit) {
  ++rays;
  if (kCheckNumerics && log) {
    bounce = camera.depth - static_cast<int>(ray.depth);
    (*log)[{bounce, false}].add(ray.origin, ray.d);
  }
  const embree::Intersection at = bvh.nearest<MALUS_EFFECT_INSTANCES != 0>(ray.origin, ray.d);
  if (at.mesh == embree::Intersection::kMiss) return false;
  const Mesh& mesh = scene.meshes[at.mesh];
#if MALUS_EFFECT_INSTANCES
  if (scene.meshTransforms[at.mesh].kind != kUnplaced) {
    hit = makeInstanceHit(ray, mesh, scene.meshTransforms[at.mesh], at.triangle);
    return true;
  }
#endif
  const glm::uvec3 corner = scene.triangles[mesh.firstTriangle + at.triangle];
  const real3* p = scene.positions.data() + mesh.firstVertex;
  const real3* n = scene.normals.data() + mesh.firstVertex;
  const real3 &p0 = p[corner.x], &p1 = p[corner.y], &p2 = p[corner.z];
  const Barycentrics b = barycentricCoordinates(ray.origin - mesh.origin, ray.d, p0, p1, p2);
  const real b0 = 1 - b.b1 - b.b2;
  const real3 interpolated =
      mesh.hasNormals != 0 ? n[corner.x] * b0 + n[corner.y] * b.b1 + n[corner.z] * b.b2 : real3(0);
#if MALUS_EFFECT_MESH_TEXTURES
  if (hasMeshTextures()) {
    const TexturedTriangle t = texturedTriangle(mesh, corner, b);
    RayCone cone;
    const TextureHit textureHit = textureHitAt(ray, mesh.origin, t, cone);
    hit = makeHit(ray, p0, p1, p2, b.b1, b.b2, mesh.origin, normalAt(mesh.material, textureHit, t, interpolated),
                  mesh.material);
    setTextureHit(hit, textureHit, t, cone);
    return true;
  }
#endif
  hit = makeHit(ray, p0, p1, p2, b.b1, b.b2, mesh.origin, interpolated, mesh.material);
  return true;
}

// Shadow rays of a hit follow the ray that met it.
bool visible([[maybe_unused]] bool needed, const real3& origin, const real3& way) {
  ++rays;
  if (kCheckNumerics && log) (*log)[{bounce, true}].add(origin, way);
  return bvh.visible(origin, way, 1);
}

bool findShadowHit([[maybe_unused]] bool needed, const Ray& ray, Hit& hit) {
  const int before = bounce;
  const bool found = findHit(ray, hit);
  bounce = before;
  return found;
}
void endShadowHits(const Hit&) {}

void noteFault(const Hit& h, const vec4& stokes, uint kind, uint colour, float slack) {
  faults.note({kind, pixelX, pixelY, camera.depth - static_cast<int>(h.depth), h.material, colour, h.c, slack,
               h.position, h.d, h.normal, stokes},
              camera.width);
}
