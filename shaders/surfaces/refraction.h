// The two sides of a clear glass interface and where light goes through it; takes the face's normal where the
// interpolated one would send the light back out.

struct Refraction {
  real n1;  // index on the side that is hit
  real n2;
  real3 through;  // refracted direction
  bool total;     // total reflection: there is none
};

FN Refraction refractAtGlass(INOUT(Hit) h, IN(Material) m) {
  Refraction way;
  way.n1 = h.outside ? m.outsideEta : m.eta.y;
  way.n2 = h.outside ? m.eta.y : m.outsideEta;
  way.through = refractedDirection(h.d, h.normal, h.c, way.n1, way.n2);
  way.total = refractionTerms(h.c, way.n1, way.n2).total;
  if (!way.total && dot3(way.through, h.face) >= R(0.0)) {
    h.normal = h.face;
    h.c = clampUnit(R(0.0) - dot3(h.d, h.face));
    way.through = refractedDirection(h.d, h.normal, h.c, way.n1, way.n2);
    way.total = refractionTerms(h.c, way.n1, way.n2).total;
  }
  return way;
}
