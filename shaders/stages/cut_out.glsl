// Whether a triangle that a ray meets is cut out there. instance, geometry, primitive, barycentric: as Vulkan reports them.
#if MALUS_EFFECT_CUT_OUTS && MALUS_EFFECT_MESH_TEXTURES
const uint kOpaqueFlag = gl_RayFlagsNoneEXT;

bool isCutOutAt(uint instance, uint geometry, uint primitive, vec2 barycentric) {
  Mesh mesh = meshes[instance + geometry];
  uvec3 corner = triangles[mesh.firstTriangle + primitive] + mesh.firstVertex;
  vec4 t = textureCoordinates[corner.x] * (1.0 - barycentric.x - barycentric.y) +
           textureCoordinates[corner.y] * barycentric.x + textureCoordinates[corner.z] * barycentric.y;
  return isCutOut(mesh.material, texturePoint(t.x, t.y, t.z, t.w));
}
#else
const uint kOpaqueFlag = gl_RayFlagsOpaqueEXT;
#endif
