// Method `importance`: the exact polarized intensity behind the camera's filter. The eye path carries importance rows
// (optics/importance.h), one for three colours until a surface with coloured Fresnel factors is met. Nothing is
// returned along rays.

#include "shaders/methods/mueller_terms.h"

CONST int kHasStokes = 1;

struct Throughput {
  real3 x;             // frame of the rows: unit, across the ray; their y is cross(-d, x)
  ImportanceVector r;  // of red, or of all three colours
  ImportanceVector g;
  ImportanceVector b;
  mask split;  // the colours have rows of their own
};

FN Throughput startThroughput(real3 d, real3 up, real behind0, real behind1, real behind2, real behind3) {
  Throughput c;
  c.x = sDirection(d, up);
  c.r.w = behind0;
  c.r.q = behind1;
  c.r.u = behind2;
  c.r.v = behind3;
  c.g = c.r;
  c.b = c.r;
  c.split = false;
  return c;
}

FN real3 colourWeights(Throughput c) { return c.split ? make3(c.r.w, c.g.w, c.b.w) : splat3(c.r.w); }

// Unpolarized light: the first number of each row.
FN real3 unpolarizedContribution(Throughput c, real3 radiance) { return colourWeights(c) * radiance; }
FN real maxComponent(Throughput c) { return c.split ? maxR(c.r.w, maxR(c.g.w, c.b.w)) : c.r.w; }

// Whether only the power of light counts: a row that is not polarized turns into itself.
FN mask isUnpolarized(ImportanceVector r) { return r.q == R(0.0) && r.u == R(0.0) && r.v == R(0.0); }

// A row whose polarization is at most `tolerance` of it loses it: what is wrong by that is at most as large a share of
// the light that it meets.
FN ImportanceVector dropSmallPolarization(ImportanceVector r, real tolerance) {
  real most = tolerance * r.w;
  if (r.q * r.q + r.u * r.u + r.v * r.v > most * most) return r;
  r.q = R(0.0);
  r.u = R(0.0);
  r.v = R(0.0);
  return r;
}
FN void dropPolarization(INOUT(Throughput) c, real tolerance) {
  if (tolerance <= R(0.0)) return;
  c.r = dropSmallPolarization(c.r, tolerance);
  if (!c.split) return;
  c.g = dropSmallPolarization(c.g, tolerance);
  c.b = dropSmallPolarization(c.b, tolerance);
}

// Into the frame of a surface with normal n: from n's components across the ray, no angle. Where they are 0 every
// frame is one of the surface's.
FN void rotateToSurface(INOUT(Throughput) c, real3 d, real3 n) {
  real3 y = cross3(c.x, d);
  real nx = dot3(n, c.x);
  real ny = dot3(n, y);
  real sum = nx * nx + ny * ny;
  if (sum < R(1e-30)) return;
  real root = R(1.0) / sqrtR(sum);
  c.x = c.x * (R(0.0) - ny * root) + y * (nx * root);
  if (!c.split && isUnpolarized(c.r)) return;
  real inverse = root * root;
  real cos2 = (ny - nx) * (ny + nx) * inverse;
  real sin2 = R(-2.0) * nx * ny * inverse;
  c.r = rotateImportance(c.r, cos2, sin2);
  if (!c.split) return;
  c.g = rotateImportance(c.g, cos2, sin2);
  c.b = rotateImportance(c.b, cos2, sin2);
}

FN void splitColours(INOUT(Throughput) c) {
  if (c.split) return;
  c.g = c.r;
  c.b = c.r;
  c.split = true;
}

// Light polarized to a degree along the s direction of a surface with normal n.
FN real3 polarizedContribution(Throughput c, real3 d, real3 n, real3 radiance, real degree) {
  rotateToSurface(c, d, n);
  real3 q = c.split ? make3(c.r.q, c.g.q, c.b.q) : splat3(c.r.q);
  return (colourWeights(c) + q * degree) * radiance;
}

FN void scaleThroughput(INOUT(Throughput) c, real3 scale) {
  if (!c.split && scale.x == scale.y && scale.y == scale.z) {
    c.r = scaleImportance(c.r, scale.x);
    return;
  }
  splitColours(c);
  c.r = scaleImportance(c.r, scale.x);
  c.g = scaleImportance(c.g, scale.y);
  c.b = scaleImportance(c.b, scale.z);
}

// Diffuse light from below the interface: unpolarized, transmitted with 1 - R_s and 1 - R_p.
FN real3 diffuseExit(Throughput c, FresnelTerms f, real3 radiance) {
  real3 mean = splat3(R(1.0)) - (f.rs + f.rp) * R(0.5);
  real3 difference = (f.rp - f.rs) * R(0.5);
  real3 q = c.split ? make3(c.r.q, c.g.q, c.b.q) : splat3(c.r.q);
  return (mean * colourWeights(c) + difference * q) * radiance;
}

FN void reflectThroughput(INOUT(Throughput) c, FresnelTerms f, mask coloured) {
  if (coloured) splitColours(c);
  c.r = applyInterfaceTransposed(c.r, f.rs.x, f.rp.x, f.xRe.x, f.xIm.x);
  if (!c.split) return;
  c.g = applyInterfaceTransposed(c.g, f.rs.y, f.rp.y, f.xRe.y, f.xIm.y);
  c.b = applyInterfaceTransposed(c.b, f.rs.z, f.rp.z, f.xRe.z, f.xIm.z);
}

// Clear glass: T_s, T_p = 1 - R_s, 1 - R_p.
FN void transmitThroughput(INOUT(Throughput) c, FresnelTerms f) {
  real ts = R(1.0) - f.rs.x;
  real tp = R(1.0) - f.rp.x;
  real x = sqrtR(ts * tp);
  c.r = applyInterfaceTransposed(c.r, ts, tp, x, R(0.0));
  if (!c.split) return;
  c.g = applyInterfaceTransposed(c.g, ts, tp, x, R(0.0));
  c.b = applyInterfaceTransposed(c.b, ts, tp, x, R(0.0));
}
