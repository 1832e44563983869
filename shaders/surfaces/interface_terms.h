// Fresnel terms of an interface, its thin film included but not its clear coat (clear_coat.h), for light at an angle of
// incidence with cosine c in [0, 1]. material: index of the surface's material, for materialExtra.

FN mask hasFilm(word material) { return lessR(R(0.0), materialExtra(material).filmEta.x); }

FN FilmLayers filmLayers(real n1, real nf, real n3, real k3, real filmStep, real baseStep, real filmOverBase,
                         real roundTripPhase) {
  FilmLayers l;
  l.n1 = n1;
  l.nf = nf;
  l.n3 = n3;
  l.k3 = k3;
  l.filmStep = filmStep;
  l.baseStep = baseStep;
  l.filmOverBase = filmOverBase;
  l.roundTripPhase = roundTripPhase;
  return l;
}

// filmEta - eta, where eta is the index of the base at the hit: a texture may have replaced the material's.
FN real3 filmOverBase(word material, real3 eta) {
  real3 constant = materialExtra(material).filmOverBase;
  if (!kEffectTextures && !kEffectMeshTextures) return constant;
  mask mapped = notM(equalW(materialExtra(material).etaMap, kNoTexture));
  return select3(mapped, (materialExtra(material).filmEta - eta) + materialExtra(material).filmResidue, constant);
}

// The film on a dielectric, for the colours 0 to 2. entering: from the outer medium into the material, else the
// reverse.
FN void dielectricFilm(IN(Material) m, word material, mask entering, OUT(FilmLayers) red, OUT(FilmLayers) green,
                       OUT(FilmLayers) blue) {
  real n1 = selectR(entering, m.outsideEta, m.eta.y);
  real n3 = selectR(entering, m.eta.y, m.outsideEta);
  real baseStep = selectR(entering, m.contrast.y, R(0.0) - m.contrast.y);
  real3 nf = materialExtra(material).filmEta;
  real3 phase = materialExtra(material).roundTripPhase;
  real3 overOutside = materialExtra(material).filmOverOutside;
  real3 overInside = filmOverBase(material, splat3(m.eta.y));
  real3 filmStep = select3(entering, overOutside, overInside);
  real3 overBase = select3(entering, overInside, overOutside);
  red = filmLayers(n1, nf.x, n3, R(0.0), filmStep.x, baseStep, overBase.x, phase.x);
  green = filmLayers(n1, nf.y, n3, R(0.0), filmStep.y, baseStep, overBase.y, phase.y);
  blue = filmLayers(n1, nf.z, n3, R(0.0), filmStep.z, baseStep, overBase.z, phase.z);
}

FN FresnelTerms filmOnDielectric(real c, IN(Material) m, word material, mask entering) {
  FilmLayers red;
  FilmLayers green;
  FilmLayers blue;
  dielectricFilm(m, material, entering, red, green, blue);
  return filmTerms(c, red, green, blue);
}

// Transmission through a film into a dielectric. A film adds phases, which 1 - R does not have.
FN FresnelTerms filmTransmission(real c, IN(Material) m, word material, mask entering) {
  FilmLayers red;
  FilmLayers green;
  FilmLayers blue;
  dielectricFilm(m, material, entering, red, green, blue);
  return filmTransmissionTerms(c, red, green, blue);
}

FN FresnelTerms filmOnConductor(real c, IN(Material) m, word material) {
  real3 nf = materialExtra(material).filmEta;
  real3 phase = materialExtra(material).roundTripPhase;
  real3 filmStep = materialExtra(material).filmOverOutside;
  real3 overBase = filmOverBase(material, m.eta);
  return filmTerms(c, filmLayers(m.outsideEta, nf.x, m.eta.x, m.k.x, filmStep.x, m.contrast.x, overBase.x, phase.x),
                   filmLayers(m.outsideEta, nf.y, m.eta.y, m.k.y, filmStep.y, m.contrast.y, overBase.y, phase.y),
                   filmLayers(m.outsideEta, nf.z, m.eta.z, m.k.z, filmStep.z, m.contrast.z, overBase.z, phase.z));
}

FN FresnelTerms bareDielectricTerms(real c, IN(Material) m, mask entering) {
  return dielectricTerms(c, selectR(entering, m.outsideEta, m.eta.y), selectR(entering, m.eta.y, m.outsideEta),
                         selectR(entering, m.contrast.y, R(0.0) - m.contrast.y));
}

// Reflection at a dielectric. entering: the light is in the outer medium, else in the material.
FN FresnelTerms filmedDielectricTerms(real c, IN(Material) m, word material, mask entering) {
  if (!kEffectCoatings) return bareDielectricTerms(c, m, entering);
  mask film = hasFilm(material);
  if (!anyM(film)) return bareDielectricTerms(c, m, entering);
  FresnelTerms f = filmOnDielectric(c, m, material, entering);
  if (anyM(notM(film))) f = selectTerms(film, f, bareDielectricTerms(c, m, entering));
  return f;
}

// Reflection at a conductor.
FN_TERMS FresnelTerms filmedConductorTerms(real c, IN(Material) m, word material) {
  if (!kEffectCoatings) return conductorTerms(c, m.outsideEta, m.eta, m.k, m.contrast);
  mask film = hasFilm(material);
  if (!anyM(film)) return conductorTerms(c, m.outsideEta, m.eta, m.k, m.contrast);
  FresnelTerms f = filmOnConductor(c, m, material);
  if (anyM(notM(film))) f = selectTerms(film, f, conductorTerms(c, m.outsideEta, m.eta, m.k, m.contrast));
  return f;
}
