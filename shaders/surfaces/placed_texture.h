// Texture coordinates and tangents of triangles that are placed by transforms.
#if MALUS_EFFECT_INSTANCES && MALUS_EFFECT_MESH_TEXTURES

// Corners and tangent in the frame of the scene; its curvature is placedCurvature() or 0.
FN TexturedTriangle placeTexture(IN(MeshTransform) t, IN(PlacedTriangle) placed, IN(TexturedTriangle) texture) {
  TexturedTriangle result = texture;
  result.p0 = placed.p0;
  result.p1 = placed.p1;
  result.p2 = placed.p2;
  result.tangent = timesColumns(t.linearX, t.linearY, t.linearZ, texture.tangent);
  result.handedness = selectR(equalW(t.kind, kMirrored), R(0.0) - texture.handedness, texture.handedness);
  return result;
}

// triangleCurvature() there. n0, n1, n2: normals of the mesh at the corners.
FN real placedCurvature(IN(MeshTransform) t, IN(PlacedTriangle) placed, real3 n0, real3 n1, real3 n2) {
  return triangleCurvature(placed.p0, placed.p1, placed.p2, normalize3(placeNormal(t, n0)),
                           normalize3(placeNormal(t, n1)), normalize3(placeNormal(t, n2)));
}

#endif
