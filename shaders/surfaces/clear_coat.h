// Reflection of whole surfaces: the interface with its film covers a share of the surface (specularFactor of
// KHR_materials_specular), and a clear coat (shaders/optics/clear_coat.h) covers a share of both. Light from the shares
// does not interfere: their Mueller matrices are added, weighted by the shares.

FN mask hasClearCoat(word material) { return lessR(R(0.0), materialExtra(material).coatShare); }

FN FresnelTerms mixTerms(FresnelTerms a, FresnelTerms b, real share) {
  return addTerms(scaleTerms(a, splat3(share)), scaleTerms(b, splat3(R(1.0) - share)));
}

// Of the interface below the coat.
FN real specularFactor(word material) {
  if (!kEffectSpecularFactors) return R(1.0);
  return materialExtra(material).specularFactor;
}

// The interface on its share of the surface.
FN FresnelTerms partialTerms(FresnelTerms f, word material) {
  real share = specularFactor(material);
  if (!anyM(lessR(share, R(1.0)))) return f;
  return scaleTerms(f, splat3(share));
}

// Terms of the coated share.
FN ClearCoat dielectricCoat(real c, IN(Material) m, word material, mask entering) {
  real base = specularFactor(material);
  return coatOnDielectric(c, selectR(entering, m.outsideEta, m.eta.y), materialExtra(material).coatEta,
                          selectR(entering, m.eta.y, m.outsideEta), selectR(entering, R(1.0), base),
                          selectR(entering, base, R(1.0)));
}
FN FresnelTerms conductorCoatTerms(real c, IN(Material) m, word material) {
  real coat = materialExtra(material).coatEta;
  real base = specularFactor(material);
  return termsFromReflectance(coatOnConductor(c, m.outsideEta, coat, m.eta.x, m.k.x, base).reflected,
                              coatOnConductor(c, m.outsideEta, coat, m.eta.y, m.k.y, base).reflected,
                              coatOnConductor(c, m.outsideEta, coat, m.eta.z, m.k.z, base).reflected);
}

// Reflection at a dielectric that does not transmit.
FN FresnelTerms coatedDielectricTerms(real c, IN(Material) m, word material) {
  FresnelTerms f = filmedDielectricTerms(c, m, material, true);
  if (kEffectSpecularFactors) f = partialTerms(f, material);
  if (kEffectClearCoats) {
    mask coat = hasClearCoat(material);
    if (anyM(coat)) {
      Reflectance r = dielectricCoat(c, m, material, true).reflected;
      f = selectTerms(coat, mixTerms(termsFromReflectance(r, r, r), f, materialExtra(material).coatShare), f);
    }
  }
  return f;
}

// Reflection at a conductor.
FN_TERMS FresnelTerms coatedConductorTerms(real c, IN(Material) m, word material) {
  FresnelTerms f = filmedConductorTerms(c, m, material);
  if (kEffectSpecularFactors) f = partialTerms(f, material);
  if (kEffectClearCoats) {
    mask coat = hasClearCoat(material);
    if (anyM(coat))
      f = selectTerms(coat, mixTerms(conductorCoatTerms(c, m, material), f, materialExtra(material).coatShare), f);
  }
  return f;
}

// Reflection at paint, mirror glass or metal.
FN_TERMS FresnelTerms opaqueTerms(real c, IN(Material) m, word material) {
  if (!kEffectMetal) return coatedDielectricTerms(c, m, material);
  mask metal = equalW(m.kind, kMetal);
  if (!anyM(metal)) return coatedDielectricTerms(c, m, material);
  FresnelTerms f = coatedConductorTerms(c, m, material);
  if (anyM(notM(metal))) f = selectTerms(metal, f, coatedDielectricTerms(c, m, material));
  return f;
}
