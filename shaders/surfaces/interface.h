// What an interface does to light at an angle with cosine c, its thin film included. index: of its material.

#if MALUS_EFFECT_COATINGS
FN bool hasFilm(uint index) { return extras[index].filmEta.x > R(0.0); }
#endif

FN Factors paintFactors(real c, IN(Material) m, uint index) {
#if MALUS_EFFECT_COATINGS
  if (hasFilm(index))
    return filmFactors(c, m.outsideEta, extras[index].filmEta, extras[index].filmTurns, splat3(m.eta.y),
                       splat3(R(0.0)));
#endif
  return dielectricFactors(c, m.outsideEta, m.eta.y);
}
FN Factors metalFactors(real c, IN(Material) m, uint index) {
#if MALUS_EFFECT_COATINGS
  if (hasFilm(index)) return filmFactors(c, m.outsideEta, extras[index].filmEta, extras[index].filmTurns, m.eta, m.k);
#endif
  return conductorFactors(c, m.outsideEta, m.eta, m.k);
}
FN Factors opaqueFactors(real c, IN(Material) m, uint index) {
#if MALUS_EFFECT_METAL
  if (m.kind == kMetal) return metalFactors(c, m, index);
#endif
  return paintFactors(c, m, index);
}
FN Factors glassFactors(real c, real n1, real n2, uint index) {
#if MALUS_EFFECT_COATINGS
  if (hasFilm(index))
    return filmFactors(c, n1, extras[index].filmEta, extras[index].filmTurns, splat3(n2), splat3(R(0.0)));
#endif
  return dielectricFactors(c, n1, n2);
}
