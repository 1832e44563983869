// Makes a hit. instance, geometry, primitive, barycentric: as Vulkan reports them; instance, the custom index, is the
// index of the first mesh of its bottom level.
#if MALUS_EFFECT_MESH_TEXTURES
#include "shaders/stages/textured_triangle.glsl"
#endif

Hit makeHitFromMesh(uint instance, uint geometry, uint primitive, vec2 barycentric, Ray ray) {
  Mesh mesh = meshes[instance + geometry];
  uvec3 corner = triangles[mesh.firstTriangle + primitive] + mesh.firstVertex;
#if MALUS_EFFECT_INSTANCES
  MeshTransform transform = meshTransforms[instance + geometry];
  if (transform.kind == kMirrored) {
    corner = corner.xzy;
    barycentric = barycentric.yx;
  }
#endif
  float b0 = 1.0 - barycentric.x - barycentric.y;
  vec3 interpolated = vec3(0.0);
  if (mesh.hasNormals != 0u)
    interpolated = normals[corner.x] * b0 + normals[corner.y] * barycentric.x + normals[corner.z] * barycentric.y;
#if MALUS_EFFECT_INSTANCES
  PlacedTriangle placed =
      placeTriangle(transform, mesh.origin, positions[corner.x], positions[corner.y], positions[corner.z]);
  interpolated = placeNormal(transform, interpolated);
#endif
#if MALUS_EFFECT_MESH_TEXTURES
  TexturedTriangle t = texturedTriangle(corner, barycentric, mesh.hasNormals != 0u);
  vec3 textureOrigin = mesh.origin;
#if MALUS_EFFECT_INSTANCES
  textureOrigin = placed.origin;
  t = placeTexture(transform, placed, t);
  if (mesh.hasNormals != 0u)
    t.curvature = placedCurvature(transform, placed, normals[corner.x], normals[corner.y], normals[corner.z]);
#endif
  RayCone cone;
  TextureHit at = textureHitAt(ray, textureOrigin, t, cone);
  interpolated = normalAt(mesh.material, at, t, interpolated);
#endif
#if MALUS_EFFECT_INSTANCES
  Hit h = makePlacedHit(ray, placed.p0, placed.p1, placed.p2, barycentric.x, barycentric.y, placed.origin, interpolated,
                        mesh.material, placed.error);
#else
  Hit h = makeHit(ray, positions[corner.x], positions[corner.y], positions[corner.z], barycentric.x, barycentric.y,
                  mesh.origin, interpolated, mesh.material);
#endif
#if MALUS_EFFECT_MESH_TEXTURES
  setTextureHit(h, at, t, cone);
#endif
  return h;
}
