// Textures: what a material has at a place, where pictures tell. Laid on by parallel projection, repeated, bilinear.

#if MALUS_EFFECT_TEXTURES
FN real3 texel(Texture t, int x, int y) {
  int width = int(t.width);
  int height = int(t.height);
  return textureTexels[int(t.first) +
                       (y < 0         ? y + height
                        : y >= height ? y - height
                                      : y) *
                           width +
                       (x < 0        ? x + width
                        : x >= width ? x - width
                                     : x)];
}

// (u, v): (0, 0) the upper left corner of the picture, (1, 1) the lower right.
FN real3 textureAt(uint index, real u, real v) {
  Texture t = textures[index];
  real x = (u - floorR(u)) * real(t.width) - R(0.5);
  real y = (v - floorR(v)) * real(t.height) - R(0.5);
  int ix = int(floorR(x));
  int iy = int(floorR(y));
  real fx = x - real(ix);
  real fy = y - real(iy);
  real3 top = texel(t, ix, iy) * (R(1.0) - fx) + texel(t, ix + 1, iy) * fx;
  real3 bottom = texel(t, ix, iy + 1) * (R(1.0) - fx) + texel(t, ix + 1, iy + 1) * fx;
  return top * (R(1.0) - fy) + bottom * fy;
}

FN Material materialAt(IN(Hit) h) {
  Material m = materials[h.material];
  MaterialExtra e = extras[h.material];
  if (e.albedoMap == kNoTexture && e.etaMap == kNoTexture && e.kMap == kNoTexture) return m;
  real3 p = h.position - e.mapOrigin;
  real u = dot3(p, e.mapU);
  real v = dot3(p, e.mapV);
  if (e.albedoMap != kNoTexture) m.albedo = m.albedo * textureAt(e.albedoMap, u, v);
  if (e.etaMap != kNoTexture) m.eta = textureAt(e.etaMap, u, v);
  if (e.kMap != kNoTexture) m.k = textureAt(e.kMap, u, v);
  return m;
}
#else
FN Material materialAt(IN(Hit) h) { return materials[h.material]; }
#endif
