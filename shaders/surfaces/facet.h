// Rough surfaces: the mirror's reflection is the mean over a fixed set of facets, each a polarized mirror. Only the
// first rough surface of a path is; behind it others are smooth, so that rays do not multiply. A depth with a fraction
// of a quarter marks such a path.

#if MALUS_EFFECT_ROUGHNESS
CONST real kBehindRough = R(0.25);

FN bool isRough(IN(Hit) h) {
  real fraction = h.depth - floorR(h.depth);
  return extras[h.material].roughness > R(0.0) && fraction <= R(0.0);
}

struct Facet {
  real3 normal;
  real c;        // cosine of incidence on it
  real3 mirror;  // where it reflects the ray to
  real weight;   // of its light in the sum; 0: it shows nothing
};

FN Facet sampleFacet(IN(Hit) h, uint index) {
  real alpha = extras[h.material].roughness;
  real3 toCamera = h.d * R(-1.0);
  Facet f;
  f.normal = facetNormal(toCamera, h.normal, alpha, camera.facets[index].x, camera.facets[index].y);
  f.c = clampUnit(dot3(toCamera, f.normal));
  f.mirror = mirrorDirection(h.d, f.normal, f.c);
  f.weight = facetWeight(toCamera, f.mirror, h.normal, alpha) * (R(1.0) / real(kFacets));
  if (dot3(f.mirror, h.face) <= R(0.0)) f.weight = R(0.0);
  return f;
}
#endif
