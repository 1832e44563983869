// Ways between a hit and the lights: which surfaces block them, and what those that transmit leave of the light.

// Light that a surface scatters toward the camera.
struct DirectLight {
  real3 diffuse;    // radiance of the Lambert layer
  real3 highlight;  // radiance in the direction of the mirror ray
};

FN DirectLight noDirectLight() {
  DirectLight none;
  none.diffuse = splat3(R(0.0));
  none.highlight = splat3(R(0.0));
  return none;
}

// The rows of the diffuse and the highlight's light on one way.
struct LightRows {
  LightRow diffuse;
  LightRow highlight;
};

// Most thin surfaces that light passes on its way to a hit; one more blocks it.
CONST uint kMostFilters = 8u;

#if MALUS_EFFECT_FILTERED_SHADOWS
// Visits the surfaces on the way, the nearest first, and multiplies the rows by each; false where one blocks.
FN mask passFilters(IN(Hit) h, IN(ShadowRay) way, mask needed, INOUT(LightRows) rows) {
  real lengthSq = dot3(way.way, way.way);
  real distance = sqrtR(lengthSq);
  Ray ray = makeRay(way.origin, way.way * (R(1.0) / divisor(distance)), R(0.0), R(0.0));
  mask passes = needed;
  mask follows = needed;
  for (uint i = 0u; i <= kMostFilters && anyM(follows); ++i) {
    Hit f = environmentHit(ray.d, ray.depth);
    mask found = andM(follows, findShadowHit(follows, ray, f));
    found = andM(found, lessR(dot3(f.position - way.origin, ray.d), distance));
    follows = found;
    if (anyM(found)) {
      Material m = materials[f.material];
      mask isPane = equalW(m.kind, kThinGlass);
      mask transmits = orM(isPane, equalW(m.kind, kPolarizingElement));
      if (i == kMostFilters) transmits = false;
      passes = andM(passes, orM(notM(found), transmits));
      follows = andM(found, transmits);
      if (anyM(follows)) {
        rows.diffuse = selectRow(follows, passFilter(rows.diffuse, f, m, isPane), rows.diffuse);
        if (kEffectHighlights)
          rows.highlight = selectRow(follows, passFilter(rows.highlight, f, m, isPane), rows.highlight);
        ray.origin = originBelow(f);
      }
    }
  }
  endShadowHits(h);
  return passes;
}
#endif

// Whether light arrives along a way; needed: the lanes that ask.
FN mask passShadow(IN(Hit) h, IN(ShadowRay) way, mask needed, INOUT(LightRows) rows) {
  if (kEffectShadows) {
    if (camera.shadows != 0u) {
#if MALUS_EFFECT_FILTERED_SHADOWS
      if (camera.filteredShadows != 0u) return passFilters(h, way, needed, rows);
#endif
      return andM(needed, visible(needed, way.origin, way.way));
    }
  }
  return needed;
}

FN LightRows startRows(IN(Hit) h, IN(Material) m, real3 d, real c, mask diffuse) {
  LightRows rows;
  real3 none = splat3(R(0.0));
  rows.highlight = startRow(d, h.normal, splat3(R(1.0)), none);
  rows.diffuse = rows.highlight;
  if (anyM(diffuse)) rows.diffuse = enteringRow(h, m, d, c);
  return rows;
}
