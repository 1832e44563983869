// Triangle with its texture coordinates. corner: indices of its vertices in the scene.
TexturePoint vertexCoordinates(uint vertex) {
  vec4 t = textureCoordinates[vertex];
  return texturePoint(t.x, t.y, t.z, t.w);
}

TexturedTriangle texturedTriangle(uvec3 corner, vec2 barycentric, bool isSmooth) {
  TexturedTriangle t;
  t.p0 = positions[corner.x];
  t.p1 = positions[corner.y];
  t.p2 = positions[corner.z];
  t.t0 = vertexCoordinates(corner.x);
  t.t1 = vertexCoordinates(corner.y);
  t.t2 = vertexCoordinates(corner.z);
  t.b1 = barycentric.x;
  t.b2 = barycentric.y;
  t.tangent = vec3(0.0);
  t.handedness = 1.0;
#if MALUS_EFFECT_NORMAL_MAPS
  vec4 tangent = tangents[corner.x] * (1.0 - barycentric.x - barycentric.y) + tangents[corner.y] * barycentric.x +
                 tangents[corner.z] * barycentric.y;
  t.tangent = tangent.xyz;
  t.handedness = tangent.w;
#endif
  t.curvature = 0.0;
  if (isSmooth)
    t.curvature = triangleCurvature(t.p0, t.p1, t.p2, normals[corner.x], normals[corner.y], normals[corner.z]);
  return t;
}
