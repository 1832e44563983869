// What the loops that carry one colour (schlick-loop, fresnel-loop) share: the share of a source's radiance that
// reaches the eye. Included after their Factors.

CONST int kHasStokes = 0;

struct Carried {
  real3 share;
};

// behind: first row of the Mueller matrix in front of the camera; of unpolarized light only its first number counts.
FN Carried carriedStart(real3 d, real3 up, real behind0, real behind1, real behind2, real behind3) {
  Carried c;
  c.share = splat3(behind0);
  return c;
}
FN real3 carriedSource(Carried c, real3 radiance) { return c.share * radiance; }
// Light polarized to a degree along the s direction of a surface with normal n.
FN real3 carriedPolarized(Carried c, real3 d, real3 n, real3 radiance, real degree) { return c.share * radiance; }
FN void carriedScale(INOUT(Carried) c, real3 scale) { c.share = c.share * scale; }
FN real carriedMost(Carried c) { return maxR(c.share.x, maxR(c.share.y, c.share.z)); }
FN void carriedForget(INOUT(Carried) c, real tolerance) {}
FN void carriedMeet(INOUT(Carried) c, real3 d, real3 n) {}
FN real3 carriedLeave(Carried c, Factors f, real3 radiance) { return c.share * meanTransmittance(f) * radiance; }
FN void carriedReflect(INOUT(Carried) c, Factors f, mask coloured) { c.share = c.share * f.r; }
FN void carriedTransmit(INOUT(Carried) c, Factors f) { c.share = c.share * (splat3(R(1.0)) - f.r); }
