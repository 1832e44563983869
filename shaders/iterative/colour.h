// What the loops that carry one colour (schlick-iterative, fresnel-iterative) share: the share of a source's radiance
// that reaches the eye. Included after their FresnelTerms.

CONST int kHasStokes = 0;

struct Throughput {
  real3 share;
};

// behind: first row of the Mueller matrix in front of the camera; of unpolarized light only its first number counts.
FN Throughput startThroughput(real3 d, real3 up, real behind0, real behind1, real behind2, real behind3) {
  Throughput c;
  c.share = splat3(behind0);
  return c;
}
FN real3 unpolarizedContribution(Throughput c, real3 radiance) { return c.share * radiance; }
// Light polarized to a degree along the s direction of a surface with normal n.
FN real3 polarizedContribution(Throughput c, real3 d, real3 n, real3 radiance, real degree) {
  return c.share * radiance;
}
FN void scaleThroughput(INOUT(Throughput) c, real3 scale) { c.share = c.share * scale; }
FN real maxComponent(Throughput c) { return maxR(c.share.x, maxR(c.share.y, c.share.z)); }
FN void dropPolarization(INOUT(Throughput) c, real tolerance) {}
FN void rotateToSurface(INOUT(Throughput) c, real3 d, real3 n) {}
FN real3 diffuseExit(Throughput c, FresnelTerms f, real3 radiance) { return c.share * meanTransmittance(f) * radiance; }
FN void reflectThroughput(INOUT(Throughput) c, FresnelTerms f, mask coloured) { c.share = c.share * f.r; }
FN void transmitThroughput(INOUT(Throughput) c, FresnelTerms f) { c.share = c.share * (splat3(R(1.0)) - f.r); }
