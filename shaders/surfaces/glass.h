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

CONST int kShapeGlass = kTransparentShape;

FN Scattering scatterGlass(INOUT(Hit) h, IN(Material) m) {
  Refraction r = refractAtGlass(h, m);
  Scattering s;
  s.frameNormal = h.normal;
  s.reflection = coatedDielectricTerms(h.c, m, h.material, h.outside);
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
  return s;
}
