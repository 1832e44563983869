// What an interface does to light at an angle with cosine c, its thin film included. index: of its material.

#if MALUS_EFFECT_COATINGS
FN bool hasFilm(uint index) { return extras[index].filmEta.x > R(0.0); }
#endif

FN FresnelTerms paintTerms(real c, IN(Material) m, uint index) {
#if MALUS_EFFECT_COATINGS
  if (hasFilm(index))
    return filmTerms(c, m.outsideEta, extras[index].filmEta, extras[index].roundTripPhase, splat3(m.eta.y),
                     splat3(R(0.0)));
#endif
  return dielectricTerms(c, m.outsideEta, m.eta.y);
}
FN FresnelTerms metalTerms(real c, IN(Material) m, uint index) {
#if MALUS_EFFECT_COATINGS
  if (hasFilm(index))
    return filmTerms(c, m.outsideEta, extras[index].filmEta, extras[index].roundTripPhase, m.eta, m.k);
#endif
  return conductorTerms(c, m.outsideEta, m.eta, m.k);
}
FN FresnelTerms opaqueTerms(real c, IN(Material) m, uint index) {
#if MALUS_EFFECT_METAL
  if (m.kind == kMetal) return metalTerms(c, m, index);
#endif
  return paintTerms(c, m, index);
}
FN FresnelTerms glassTerms(real c, real n1, real n2, uint index) {
#if MALUS_EFFECT_COATINGS
  if (hasFilm(index))
    return filmTerms(c, n1, extras[index].filmEta, extras[index].roundTripPhase, splat3(n2), splat3(R(0.0)));
#endif
  return dielectricTerms(c, n1, n2);
}
