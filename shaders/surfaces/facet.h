// Rough surfaces: the reflection is the mean over a fixed set of microfacets, each a polarized mirror. Only the first
// rough surface of a path is treated so; later ones are smooth, so that rays do not multiply. A depth with a fraction
// of a quarter marks a path behind a rough surface.

CONST_REAL(kBehindRough, 0.25);

FN real roughnessAt(IN(Hit) h) {
  real roughness = materialExtra(h.material).roughness;
#if MALUS_EFFECT_MESH_TEXTURES
  roughness = selectR(lessR(h.roughness, R(0.0)), roughness, h.roughness);
#endif
  return roughness;
}

FN mask isRough(IN(Hit) h) {
  real fraction = h.depth - floorR(h.depth);
  return andM(lessR(R(0.0), roughnessAt(h)), lessEqualR(fraction, R(0.0)));
}

struct Facet {
  real3 normal;
  real c;        // cosine of the angle of incidence on the facet
  real3 mirror;  // direction of the reflected ray
  real weight;   // of its light in the mean; 0 where it reflects nothing
};

FN VisibleFacets visibleFacetsAt(IN(Hit) h) { return visibleFacets(h.d * R(-1.0), h.normal, roughnessAt(h)); }

// Facet for a point (px, py) of the unit disk (optics/facets.h).
FN Facet sampleFacet(IN(Hit) h, IN(VisibleFacets) visible, real px, real py) {
  Facet f;
  f.normal = facetNormal(visible, px, py);
  f.c = clampUnit(R(0.0) - dot3(h.d, f.normal));
  f.mirror = mirrorDirection(h.d, f.normal, f.c);
  f.weight = facetWeight(visible, f.mirror) * (R(1.0) / R(kFacets));
  f.weight = selectR(lessEqualR(dot3(f.mirror, h.face), R(0.0)), R(0.0), f.weight);
  return f;
}

// Ray that facet `index` of the set reflects.
FN Ray facetRay(IN(Hit) h, IN(Facet) f, word index) {
  Ray ray = rayFrom(h, originAbove(h), f.mirror, h.depth - R(1.0) + kBehindRough);
#if MALUS_PATH_WORD
  ray.path = facetPath(h.path, index);
#if MALUS_EFFECT_MESH_TEXTURES
  if (kEffectMeshTextures) {
    // The mirror directions fill a cone of about twice alpha around their mean, of which each of 16 facets has a share.
    RayCone cone = reflectedCone(coneOfBits(h.path), h.curvature, h.c);
    cone.spread = cone.spread + R(0.5) * roughnessAt(h);
    ray.path = pathWithCone(ray.path, cone);
  }
#endif
#endif
  return ray;
}
