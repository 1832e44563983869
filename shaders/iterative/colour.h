// Throughput of the iterative methods without polarization (schlick-iterative, fresnel-iterative): the share of a
// source's radiance, per colour, that reaches the camera. Included after their FresnelTerms.

CONST int kHasStokes = 0;

struct Throughput {
  real3 share;
};

CONST int kSharedFields = 3;
CONST uint kUnpolarizedFields = 7u;

FN mask isSplit(IN(Throughput) c) { return false; }

// behind: first row of the Mueller matrix in front of the camera; unpolarized light needs only its first number.
FN Throughput startThroughput(real3 d, real3 up, real behind0, real behind1, real behind2, real behind3) {
  Throughput c;
  c.share = splat3(behind0);
  return c;
}
FN real3 unpolarizedContribution(IN(Throughput) c, real3 radiance) { return c.share * radiance; }
// Light with a degree of linear polarization along the s direction of a surface with normal n.
FN real3 polarizedContribution(IN(Throughput) c, real3 d, real3 n, real3 radiance, real degree) {
  return c.share * radiance;
}
FN void scaleThroughput(INOUT(Throughput) c, real3 scale) { c.share = c.share * scale; }
FN real maxComponent(IN(Throughput) c) { return maxR(c.share.x, maxR(c.share.y, c.share.z)); }
FN void dropPolarization(INOUT(Throughput) c, real tolerance) {}
FN void rotateToSurface(INOUT(Throughput) c, real3 d, real3 n) {}
FN real3 diffuseExit(IN(Throughput) c, IN(FresnelTerms) f, real3 radiance) {
  return c.share * meanTransmittance(f) * radiance;
}
FN void applyInterface(INOUT(Throughput) c, IN(FresnelTerms) f, mask coloured) { c.share = c.share * f.r; }
// Behind a surface with normal n and a further factor.
FN_INLINE Throughput unpolarizedBehind(Throughput c, real3 d, real3 n, IN(FresnelTerms) f, real factor) {
  c.share = c.share * f.r * factor;
  return c;
}
