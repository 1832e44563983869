// Material at a hit: textures in place of, or multiplied with, its constants. Those of parallel projection are repeated
// and bilinear; mesh_textures.h has those by texture coordinates.

#if MALUS_EFFECT_TEXTURES
FN real3 textureAt(word index, real u, real v) {
  real width;
  real height;
  textureSize(index, width, height);
  TexelPosition p = textureTexelPosition(u, v, width, height);
  real right = p.x + R(1.0);
  real below = p.y + R(1.0);
  return bilinear(texel(index, p.x, p.y), texel(index, right, p.y), texel(index, p.x, below),
                  texel(index, right, below), p.fx, p.fy);
}

FN mask isMapped(word index) { return notM(orM(equalW(index, kNoTexture), equalW(index, kMeshTexture))); }

FN Material projectedMaterial(IN(Hit) h) {
  Material m = materials[h.material];
  if (!kEffectTextures) return m;
  MaterialExtra e = materialExtra(h.material);
  mask albedo = isMapped(e.albedoMap);
  mask eta = isMapped(e.etaMap);
  mask k = isMapped(e.kMap);
  if (!anyM(orM(albedo, orM(eta, k)))) return m;
  real3 p = h.position - e.mapOrigin;
  real u = dot3(p, e.mapU);
  real v = dot3(p, e.mapV);
  if (anyM(albedo)) m.albedo = select3(albedo, m.albedo * textureAt(e.albedoMap, u, v), m.albedo);
  if (anyM(eta)) {
    m.eta = select3(eta, textureAt(e.etaMap, u, v), m.eta);
    m.contrast = select3(eta, (m.eta - splat3(m.outsideEta)) - splat3(e.outsideResidue), m.contrast);
  }
  if (anyM(k)) m.k = select3(k, textureAt(e.kMap, u, v), m.k);
  return m;
}
#else
FN Material projectedMaterial(IN(Hit) h) { return materials[h.material]; }
#endif

FN Material materialAt(IN(Hit) h) {
  Material m = projectedMaterial(h);
#if MALUS_EFFECT_MESH_TEXTURES
  if (hasMeshTextures()) applyMeshMaps(m, h);
#endif
  return m;
}
