// Makes a hit. instance, geometry, primitive, barycentric: as Vulkan reports them; instance, the custom index, is the
// index of the first mesh of its bottom level. origin, d: the ray. depth: specular interactions left.
Hit makeHitFromMesh(uint instance, uint geometry, uint primitive, vec2 barycentric, vec3 origin, vec3 d, float depth) {
  Mesh mesh = meshes[instance + geometry];
  uvec3 corner = triangles[mesh.firstTriangle + primitive] + mesh.firstVertex;
  float b0 = 1.0 - barycentric.x - barycentric.y;
  vec3 interpolated = vec3(0.0);
  if (mesh.hasNormals != 0u)
    interpolated = normals[corner.x] * b0 + normals[corner.y] * barycentric.x + normals[corner.z] * barycentric.y;
  Hit h = makeHit(origin, d, positions[corner.x], positions[corner.y], positions[corner.z], barycentric.x, barycentric.y,
                 mesh.origin, interpolated, depth, mesh.material);
  if (kEffectAbsorption) h.travelled = length(h.position - origin);
  return h;
}
