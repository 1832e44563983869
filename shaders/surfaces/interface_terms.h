// Fresnel terms of an interface, its thin film included, for light at an angle of incidence with cosine c in [0, 1].
// material: index of the surface's material, for materialExtra.

FN mask hasFilm(word material) { return lessR(R(0.0), materialExtra(material).filmEta.x); }

FN FresnelTerms filmOnDielectric(real c, real n1, real n2, word material) {
  return filmTerms(c, n1, materialExtra(material).filmEta, materialExtra(material).roundTripPhase, splat3(n2),
                   splat3(R(0.0)));
}

// Reflection at a dielectric: light in a medium of index n1 meets one of index n2.
FN FresnelTerms coatedDielectricTerms(real c, real n1, real n2, word material) {
  if (!kEffectCoatings) return dielectricTerms(c, n1, n2);
  mask film = hasFilm(material);
  if (!anyM(film)) return dielectricTerms(c, n1, n2);
  FresnelTerms f = filmOnDielectric(c, n1, n2, material);
  if (anyM(notM(film))) f = selectTerms(film, f, dielectricTerms(c, n1, n2));
  return f;
}

// Transmission through a film into a dielectric. A film adds phases, which 1 - R does not have.
FN FresnelTerms filmTransmission(real c, real n1, real n2, word material) {
  return filmTransmissionTerms(c, n1, materialExtra(material).filmEta, materialExtra(material).roundTripPhase,
                               splat3(n2));
}

// Reflection at a conductor.
FN FresnelTerms coatedConductorTerms(real c, IN(Material) m, word material) {
  if (!kEffectCoatings) return conductorTerms(c, m.outsideEta, m.eta, m.k);
  mask film = hasFilm(material);
  if (!anyM(film)) return conductorTerms(c, m.outsideEta, m.eta, m.k);
  FresnelTerms f =
      filmTerms(c, m.outsideEta, materialExtra(material).filmEta, materialExtra(material).roundTripPhase, m.eta, m.k);
  if (anyM(notM(film))) f = selectTerms(film, f, conductorTerms(c, m.outsideEta, m.eta, m.k));
  return f;
}

// Reflection at paint, mirror glass or metal.
FN FresnelTerms opaqueTerms(real c, IN(Material) m, word material) {
  if (!kEffectMetal) return coatedDielectricTerms(c, m.outsideEta, m.eta.y, material);
  mask metal = equalW(m.kind, kMetal);
  if (!anyM(metal)) return coatedDielectricTerms(c, m.outsideEta, m.eta.y, material);
  FresnelTerms f = coatedConductorTerms(c, m, material);
  if (anyM(notM(metal))) f = selectTerms(metal, f, coatedDielectricTerms(c, m.outsideEta, m.eta.y, material));
  return f;
}
