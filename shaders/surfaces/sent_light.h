// Recursive methods: the light of a surface as a payload, and the light of its rays in its frame. The drivers (shade.h,
// shade_stack.h) trace the rays.
// slack: rounding error of the light that has met the surface so far (check.h).

FN mask canScatter(IN(Hit) h) { return lessR(R(0.5), h.depth); }

FN Payload black() { return payloadUnpolarized(splat3(R(0.0))); }

// Transmittance of the medium that the ray came through; 1 without absorption.
FN real3 arrivalTransmittance(IN(Hit) h) {
  if (kEffectAbsorption) return mediumTransmittance(h);
  return splat3(R(1.0));
}

// Payload of light that leaves a surface with s direction sDir against a ray in direction d. transmittance: of the
// medium that the ray came through.
FN Payload sentPayload(IN(SurfaceLight) toCamera, real3 d, real3 sDir, real3 transmittance) {
  if (kEffectAbsorption) return payloadFromSurface(lightScale(toCamera, transmittance), d, sDir);
  return payloadFromSurface(toCamera, d, sDir);
}

// Light that returned along a ray in direction d, in the frame of the surface that sent the ray.
FN_INLINE SurfaceLight returnedLight(IN(Payload) returned, real3 d, real3 sDir, INOUT(real3) slack) {
  if (kCheckNumerics) slack = slack + roundingSlack(payloadStokes(returned, d));
  return lightAtSurface(returned, d, sDir);
}

// Light that one facet reflects toward the camera, in the frame of the surface. returned: of the facet's ray.
FN SurfaceLight facetLight(IN(Hit) h, IN(Material) m, IN(Facet) facet, IN(Payload) returned, real3 sDir,
                           INOUT(real3) slack) {
  FresnelTerms f = opaqueTerms(facet.c, m, h.material);
  real3 facetS = surfaceS(h.d, facet.normal);
  SurfaceLight reflected = lightThroughInterface(f, returnedLight(returned, facet.mirror, facetS, slack));
  Payload sent = payloadFromSurface(lightScale(reflected, splat3(facet.weight)), h.d, facetS);
  return lightAtSurface(sent, h.d, sDir);
}
