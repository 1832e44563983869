// Interface of a clear glass body: reflects and transmits.

struct Refraction {
  real3 direction;
  mask total;  // total reflection: there is no refracted ray
};

FN RefractionTerms glassTerms(IN(Hit) h, IN(Material) m) {
  return refractionTermsWith(h.c, selectR(h.outside, m.outsideEta, m.eta.y), selectR(h.outside, m.eta.y, m.outsideEta),
                             selectR(h.outside, m.contrast.y, R(0.0) - m.contrast.y));
}

// Refracts the ray of the hit. Where the interpolated normal would refract it to the side that it came from, the hit
// takes the face's normal.
FN Refraction refractAtGlass(INOUT(Hit) h, IN(Material) m) {
  Refraction r;
  RefractionTerms f = glassTerms(h, m);
  r.direction = refractedDirectionFromTerms(h.d, h.normal, h.c, f);
  r.total = f.total;
  mask wrongSide = andM(notM(r.total), lessEqualR(R(0.0), dot3(r.direction, h.face)));
  if (anyM(wrongSide)) {
    h.normal = select3(wrongSide, h.face, h.normal);
    h.c = selectR(wrongSide, clampUnit(R(0.0) - dot3(h.d, h.face)), h.c);
    // The other lanes get what they have: their normal is the same.
    f = glassTerms(h, m);
    r.direction = refractedDirectionFromTerms(h.d, h.normal, h.c, f);
    r.total = f.total;
  }
  return r;
}

// Transmission of the part of a surface that has no interface.
FN FresnelTerms clearTerms() {
  Reflectance clear;
  clear.rs = R(1.0);
  clear.rp = R(1.0);
  clear.xRe = R(1.0);
  clear.xIm = R(0.0);
  return termsFromReflectance(clear, clear, clear);
}

// Leaves an interface on a share of the surface. Total reflection is not reduced: there is no refracted ray.
FN void applySpecularFactor(INOUT(Scattering) s, IN(Hit) h) {
  real share = selectR(s.transmits, specularFactor(h.material), R(1.0));
  if (!anyM(lessR(share, R(1.0)))) return;
  s.reflection = scaleTerms(s.reflection, splat3(share));
  s.transmission = mixTerms(s.transmission, clearTerms(), share);
}

FN void applyClearCoat(INOUT(Scattering) s, IN(Hit) h, IN(Material) m) {
  mask coat = hasClearCoat(h.material);
  if (!anyM(coat)) return;
  ClearCoat layer = dielectricCoat(h.c, m, h.material, h.outside);
  real share = materialExtra(h.material).coatShare;
  FresnelTerms reflected = termsFromReflectance(layer.reflected, layer.reflected, layer.reflected);
  FresnelTerms transmitted = termsFromReflectance(layer.transmitted, layer.transmitted, layer.transmitted);
  s.reflection = selectTerms(coat, mixTerms(reflected, s.reflection, share), s.reflection);
  s.transmission = selectTerms(coat, mixTerms(transmitted, s.transmission, share), s.transmission);
}

// The base colour tints the light at each passage through the boundary of a volume, as KHR_materials_transmission
// (specular_btdf x baseColor) and KHR_materials_volume (Base Color and Absorption) state.
FN void applyTint(INOUT(Scattering) s, IN(Hit) h, IN(Material) m) {
  real3 tint = materialExtra(h.material).transmittanceParallel;
#if MALUS_EFFECT_MESH_TEXTURES
  tint = select3(equalW(meshMaps(h.material).transmittance, 0u), tint, m.radiance);
#endif
  mask tints = notM(andM(equalR(tint.x, R(1.0)), andM(equalR(tint.y, R(1.0)), equalR(tint.z, R(1.0)))));
  if (!anyM(tints)) return;
  s.transmission = scaleTerms(s.transmission, tint);
  s.coloured = orM(s.coloured, tints);
}

CONST int kShapeGlass = kTransparentShape;

FN Scattering scatterGlass(INOUT(Hit) h, IN(Material) m) {
  Refraction r = refractAtGlass(h, m);
  Scattering s;
  s.frameNormal = h.normal;
  s.reflection = filmedDielectricTerms(h.c, m, h.material, h.outside);
  s.reflected = mirrorDirection(h.d, h.normal, h.c);
  s.transmitted = r.direction;
  s.reflects = true;
  s.transmits = notM(r.total);
  s.transmission = transmissionTerms(s.reflection);
  s.coloured = false;
  if (kEffectCoatings) {
    s.coloured = hasFilm(h.material);
    mask film = andM(s.coloured, s.transmits);
    if (anyM(film)) s.transmission = selectTerms(film, filmTransmission(h.c, m, h.material, h.outside), s.transmission);
  }
  if (kEffectSpecularFactors) applySpecularFactor(s, h);
  if (kEffectClearCoats) applyClearCoat(s, h, m);
  if (kEffectTintedGlass) applyTint(s, h, m);
  return s;
}
