// Steps along a camera path, without tracing: the rays that leave a surface and the light that a path meets.

struct CameraPath {
  Ray ray;
  Throughput throughput;
};

// Light where a ray of a path ends.
struct PathLight {
  real3 recorded;  // part of it that the camera records
  real3 emitted;   // radiance as it leaves its sources, the scale of their rounding errors (check.h)
};

FN PathLight noLight() {
  PathLight l;
  l.recorded = splat3(R(0.0));
  l.emitted = splat3(R(0.0));
  return l;
}

FN PathLight unpolarizedLight(IN(Throughput) c, real3 radiance) {
  PathLight l;
  l.recorded = unpolarizedContribution(c, radiance);
  l.emitted = radiance;
  return l;
}

// Light with a degree of linear polarization along the s direction of a surface with normal n.
FN PathLight polarizedLight(IN(Throughput) c, real3 d, real3 n, real3 radiance, real degree) {
  PathLight l;
  l.recorded = polarizedContribution(c, d, n, radiance, degree);
  l.emitted = radiance;
  return l;
}

FN PathLight emitterLight(IN(Hit) h, IN(Material) m, IN(Throughput) c) {
  if (kEffectPolarizedEmitters)
    return polarizedLight(c, h.d, emissionNormal(h), emission(h, m), materialExtra(h.material).degree);
  return unpolarizedLight(c, emission(h, m));
}

// The next ray of a path whose throughput has been rotated to the surface. tolerance: relative error that may be lost
// with small polarization.

FN void followTransmission(INOUT(CameraPath) p, IN(Hit) h, IN(Scattering) s, real tolerance) {
  p.ray = rayBelow(h, s.transmitted, h.depth - R(1.0));
  applyInterface(p.throughput, s.transmission, s.coloured);
  dropPolarization(p.throughput, tolerance);
}

// The throughput is that behind the reflection already: the highlight joins the light of the mirror ray.
FN void followReflection(INOUT(CameraPath) p, IN(Hit) h, IN(Scattering) s, real tolerance) {
  p.ray = rayAbove(h, s.reflected, h.depth - R(1.0));
  dropPolarization(p.throughput, tolerance);
}

// The throughput behind a facet of a rough surface.
FN Throughput behindFacet(Throughput c, IN(Hit) h, IN(Material) m, IN(Facet) facet, mask coloured, real tolerance) {
  rotateToSurface(c, h.d, facet.normal);
  applyInterface(c, opaqueTerms(facet.c, m, h.material), coloured);
  scaleThroughput(c, splat3(facet.weight));
  dropPolarization(c, tolerance);
  return c;
}
// Of it, what unpolarizedContribution needs.
FN_INLINE Throughput unpolarizedBehindFacet(IN(Throughput) c, IN(Hit) h, IN(Material) m, IN(Facet) facet) {
  return unpolarizedBehind(c, h.d, facet.normal, opaqueTerms(facet.c, m, h.material), facet.weight);
}

FN void followFacet(INOUT(CameraPath) p, IN(Hit) h, IN(Material) m, IN(Facet) facet, word index, mask coloured,
                    real tolerance) {
  p.ray = facetRay(h, facet, index);
  p.throughput = behindFacet(p.throughput, h, m, facet, coloured, tolerance);
}
