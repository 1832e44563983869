// Material at a hit: textures in place of, or multiplied with, its constants. Parallel projection, repeated, bilinear.

#if MALUS_EFFECT_TEXTURES
// Texel of a repeated texture; x and y at most one texel outside.
FN real3 texel(Texture t, int x, int y) {
  int width = int(t.width);
  int height = int(t.height);
  int column = x < 0 ? x + width : x >= width ? x - width : x;
  int row = y < 0 ? y + height : y >= height ? y - height : y;
  return textureTexels[int(t.first) + row * width + column];
}

FN real3 textureAt(word index, real u, real v) {
  Texture t = textures[index];
  TexelPosition p = textureTexelPosition(u, v, real(t.width), real(t.height));
  int x = int(p.x);
  int y = int(p.y);
  return bilinear(texel(t, x, y), texel(t, x + 1, y), texel(t, x, y + 1), texel(t, x + 1, y + 1), p.fx, p.fy);
}

FN Material materialAt(IN(Hit) h) {
  Material m = materials[h.material];
  MaterialExtra e = materialExtra(h.material);
  if (e.albedoMap == kNoTexture && e.etaMap == kNoTexture && e.kMap == kNoTexture) return m;
  real3 p = h.position - e.mapOrigin;
  real u = dot3(p, e.mapU);
  real v = dot3(p, e.mapV);
  if (e.albedoMap != kNoTexture) m.albedo = m.albedo * textureAt(e.albedoMap, u, v);
  if (e.etaMap != kNoTexture) {
    m.eta = textureAt(e.etaMap, u, v);
    m.contrast = (m.eta - splat3(m.outsideEta)) - splat3(e.outsideResidue);
  }
  if (e.kMap != kNoTexture) m.k = textureAt(e.kMap, u, v);
  return m;
}
#else
FN Material materialAt(IN(Hit) h) { return materials[h.material]; }
#endif
