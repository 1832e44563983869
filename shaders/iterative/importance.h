// Method `importance`: the exact polarized intensity behind the camera's filter. The camera path carries importance
// vectors (optics/importance.h), one for all colours until a surface whose terms differ between colours. Nothing is
// returned along rays.

#include "shaders/methods/mueller_terms.h"

CONST int kHasStokes = 1;

struct Throughput {
  real3 x;             // frame of the vectors: unit, perpendicular to the ray; their y is cross(-d, x)
  ImportanceVector r;  // of red, or of all colours
  real split;          // 1: green and blue have their own vectors; else 0
  ImportanceVector g;
  ImportanceVector b;
};

// Fields before those that only a split throughput has.
CONST int kSharedFields = 8;
// Bit i: unpolarizedContribution reads field i. They are r.w, split, g.w and b.w.
CONST uint kUnpolarizedFields = 0x1188u;

// d: direction of the camera ray; behind: first row of the Mueller matrix in front of the camera.
FN Throughput startThroughput(real3 d, real3 up, real behind0, real behind1, real behind2, real behind3) {
  Throughput c;
  c.x = sDirection(d, up);
  c.r.w = behind0;
  c.r.q = behind1;
  c.r.u = behind2;
  c.r.v = behind3;
  c.g = c.r;
  c.b = c.r;
  c.split = R(0.0);
  return c;
}

FN mask isSplit(IN(Throughput) c) { return lessR(R(0.5), c.split); }
FN real3 colourWeights(IN(Throughput) c) { return select3(isSplit(c), make3(c.r.w, c.g.w, c.b.w), splat3(c.r.w)); }
FN real3 colourLinear(IN(Throughput) c) { return select3(isSplit(c), make3(c.r.q, c.g.q, c.b.q), splat3(c.r.q)); }

// Unpolarized light: the first component of each vector.
FN real3 unpolarizedContribution(IN(Throughput) c, real3 radiance) { return colourWeights(c) * radiance; }
FN real maxComponent(IN(Throughput) c) { return selectR(isSplit(c), maxR(c.r.w, maxR(c.g.w, c.b.w)), c.r.w); }

// Without polarization components a vector is the same in every frame.
FN mask isUnpolarized(ImportanceVector r) {
  return andM(equalR(r.q, R(0.0)), andM(equalR(r.u, R(0.0)), equalR(r.v, R(0.0))));
}

// Sets the polarization to 0 where it is at most `tolerance` times w. The relative error that this adds to the light
// that arrives is at most `tolerance`.
FN ImportanceVector dropSmallPolarization(ImportanceVector r, real tolerance) {
  real bound = tolerance * r.w;
  mask drops = andM(lessR(R(0.0), tolerance), notM(lessR(bound * bound, r.q * r.q + r.u * r.u + r.v * r.v)));
  ImportanceVector t;
  t.w = r.w;
  t.q = selectR(drops, R(0.0), r.q);
  t.u = selectR(drops, R(0.0), r.u);
  t.v = selectR(drops, R(0.0), r.v);
  return t;
}
FN void dropPolarization(INOUT(Throughput) c, real tolerance) {
  if (!anyM(lessR(R(0.0), tolerance))) return;
  c.r = dropSmallPolarization(c.r, tolerance);
  if (!anyM(isSplit(c))) return;
  c.g = selectImportance(isSplit(c), dropSmallPolarization(c.g, tolerance), c.g);
  c.b = selectImportance(isSplit(c), dropSmallPolarization(c.b, tolerance), c.b);
}

// Into the frame of a surface with normal n, from n's components perpendicular to the ray. At normal incidence, where
// they are 0, every frame is a frame of the surface.
FN_INLINE void rotateToSurface(INOUT(Throughput) c, real3 d, real3 n) {
  real3 y = cross3(c.x, d);
  real nx = dot3(n, c.x);
  real ny = dot3(n, y);
  real sum = nx * nx + ny * ny;
  mask inclined = notM(lessR(sum, R(1e-30)));
  if (!anyM(inclined)) return;
  real root = R(1.0) / sqrtR(sum);
  c.x = select3(inclined, c.x * (R(0.0) - ny * root) + y * (nx * root), c.x);
  mask rotates = andM(inclined, orM(isSplit(c), notM(isUnpolarized(c.r))));
  if (!anyM(rotates)) return;
  real inverse = root * root;
  real cos2 = (ny - nx) * (ny + nx) * inverse;
  real sin2 = R(-2.0) * nx * ny * inverse;
  c.r = selectImportance(rotates, rotateImportance(c.r, cos2, sin2), c.r);
  mask splitRotates = andM(rotates, isSplit(c));
  if (!anyM(splitRotates)) return;
  c.g = selectImportance(splitRotates, rotateImportance(c.g, cos2, sin2), c.g);
  c.b = selectImportance(splitRotates, rotateImportance(c.b, cos2, sin2), c.b);
}

// Gives green and blue their own vectors where `coloured`.
FN void splitColours(INOUT(Throughput) c, mask coloured) {
  mask splits = andM(coloured, notM(isSplit(c)));
  if (!anyM(splits)) return;
  c.g = selectImportance(splits, c.r, c.g);
  c.b = selectImportance(splits, c.r, c.b);
  c.split = selectR(splits, R(1.0), c.split);
}

// Light with a degree of linear polarization along the s direction of a surface with normal n.
FN real3 polarizedContribution(Throughput c, real3 d, real3 n, real3 radiance, real degree) {
  rotateToSurface(c, d, n);
  return (colourWeights(c) + colourLinear(c) * degree) * radiance;
}

FN void scaleThroughput(INOUT(Throughput) c, real3 scale) {
  splitColours(c, notM(andM(equalR(scale.x, scale.y), equalR(scale.y, scale.z))));
  c.r = scaleImportance(c.r, scale.x);
  if (!anyM(isSplit(c))) return;
  c.g = selectImportance(isSplit(c), scaleImportance(c.g, scale.y), c.g);
  c.b = selectImportance(isSplit(c), scaleImportance(c.b, scale.z), c.b);
}

// Diffuse light from below the interface: unpolarized, transmitted with 1 - R_s and 1 - R_p.
FN real3 diffuseExit(IN(Throughput) c, IN(FresnelTerms) f, real3 radiance) {
  real3 mean = splat3(R(1.0)) - (f.rs + f.rp) * R(0.5);
  real3 difference = (f.rp - f.rs) * R(0.5);
  return (mean * colourWeights(c) + difference * colourLinear(c)) * radiance;
}

// Through an interface, against the light. coloured: the terms differ between colours.
FN_INLINE void applyInterface(INOUT(Throughput) c, IN(FresnelTerms) f, mask coloured) {
  splitColours(c, coloured);
  c.r = applyInterfaceTransposed(c.r, f.rs.x, f.rp.x, f.xRe.x, f.xIm.x);
  if (!anyM(isSplit(c))) return;
  c.g = selectImportance(isSplit(c), applyInterfaceTransposed(c.g, f.rs.y, f.rp.y, f.xRe.y, f.xIm.y), c.g);
  c.b = selectImportance(isSplit(c), applyInterfaceTransposed(c.b, f.rs.z, f.rp.z, f.xRe.z, f.xIm.z), c.b);
}

// Of the throughput behind a surface with normal n and a further factor, what unpolarizedContribution needs.
FN_INLINE Throughput unpolarizedBehind(Throughput c, real3 d, real3 n, IN(FresnelTerms) f, real factor) {
  rotateToSurface(c, d, n);
  real3 mean = (f.rs + f.rp) * R(0.5);
  real3 difference = (f.rs - f.rp) * R(0.5);
  real3 weights = (mean * colourWeights(c) + difference * colourLinear(c)) * factor;
  c.r.w = weights.x;
  c.g.w = weights.y;
  c.b.w = weights.z;
  c.split = R(1.0);
  return c;
}
