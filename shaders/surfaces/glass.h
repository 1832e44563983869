// Interface of a clear glass body: reflects and transmits.

struct Refraction {
  real n1;  // index on the side that is hit
  real n2;  // index on the other side
  real3 direction;
  mask total;  // total reflection: there is no refracted ray
};

// Refracts the ray of the hit. Where the interpolated normal would refract it to the side that it came from, the hit
// takes the face's normal.
FN Refraction refractAtGlass(INOUT(Hit) h, IN(Material) m) {
  Refraction r;
  r.n1 = selectR(h.outside, m.outsideEta, m.eta.y);
  r.n2 = selectR(h.outside, m.eta.y, m.outsideEta);
  r.direction = refractedDirection(h.d, h.normal, h.c, r.n1, r.n2);
  r.total = refractionTerms(h.c, r.n1, r.n2).total;
  mask wrongSide = andM(notM(r.total), lessEqualR(R(0.0), dot3(r.direction, h.face)));
  if (anyM(wrongSide)) {
    h.normal = select3(wrongSide, h.face, h.normal);
    h.c = selectR(wrongSide, clampUnit(R(0.0) - dot3(h.d, h.face)), h.c);
    // The other lanes get what they have: their normal is the same.
    r.direction = refractedDirection(h.d, h.normal, h.c, r.n1, r.n2);
    r.total = refractionTerms(h.c, r.n1, r.n2).total;
  }
  return r;
}

CONST int kShapeGlass = kTransparentShape;

FN Scattering scatterGlass(INOUT(Hit) h, IN(Material) m) {
  Refraction r = refractAtGlass(h, m);
  Scattering s;
  s.frameNormal = h.normal;
  s.reflection = coatedDielectricTerms(h.c, r.n1, r.n2, h.material);
  s.reflected = mirrorDirection(h.d, h.normal, h.c);
  s.transmitted = r.direction;
  s.reflects = true;
  s.transmits = notM(r.total);
  s.transmission = transmissionTerms(s.reflection);
  s.coloured = false;
  if (kEffectCoatings) {
    s.coloured = hasFilm(h.material);
    mask film = andM(s.coloured, s.transmits);
    if (anyM(film)) s.transmission = selectTerms(film, filmTransmission(h.c, r.n1, r.n2, h.material), s.transmission);
  }
  return s;
}
