// Microfacets of a rough surface: GGX distribution of roughness alpha in (0, 1], sampled among the facets visible from
// the camera. The mean over facets of their reflection times facetWeight is the surface's reflection. toCamera,
// toLight, n: unit vectors.

// Values that the facets of one surface share for one direction of view.
struct VisibleFacets {
  real3 n;
  real alpha;
  real3 across;  // unit, perpendicular to the plane of toCamera and n
  real3 along;   // cross(n, across)
  real vy;       // direction of view, stretched so that the surface has roughness 1: (0, vy, vz)
  real vz;
  real c;     // cosine of toCamera and n, at least 0
  real root;  // smithRoot of c
};

// sqrt(c^2 + alpha^2 (1 - c^2)): Smith's Lambda is (root/c - 1)/2. c: cosine of a direction and n, at least 0.
FN real smithRoot(real c, real alpha) { return sqrtR(c * c + alpha * alpha * maxR(R(1.0) - c * c, R(0.0))); }

FN VisibleFacets visibleFacets(real3 toCamera, real3 n, real alpha) {
  VisibleFacets f;
  f.n = n;
  f.alpha = alpha;
  f.across = sDirection(toCamera * R(-1.0), n);  // perpendicular to the plane of incidence
  f.along = cross3(n, f.across);
  f.c = maxR(dot3(toCamera, n), R(0.0));
  f.root = smithRoot(f.c, alpha);
  real y = alpha * dot3(toCamera, f.along);
  real inverse = R(1.0) / sqrtR(maxR(y * y + f.c * f.c, R(1e-30)));
  f.vy = y * inverse;
  f.vz = f.c * inverse;
  return f;
}

// Unit normal of the facet for a point (px, py) of the unit disk. The disk's first axis is f.across. Source: Heitz,
// Sampling the GGX Distribution of Visible Normals, JCGT 7(4), 2018, sections 3 and 4.
FN real3 facetNormal(IN(VisibleFacets) f, real px, real py) {
  // Project the disk's point onto the hemisphere visible from the stretched view; the disk's axes are across and
  // (0, -vz, vy).
  real s = R(0.5) * (R(1.0) + f.vz);
  real t1Sq = maxR(R(1.0) - px * px, R(0.0));
  real t2 = (R(1.0) - s) * sqrtR(t1Sq) + s * py;
  real t3 = sqrtR(maxR(t1Sq - t2 * t2, R(0.0)));
  real hy = t3 * f.vy - t2 * f.vz;
  real hz = t3 * f.vz + t2 * f.vy;
  // Undo the stretch.
  return normalize3(f.across * (f.alpha * px) + f.along * (f.alpha * hy) + f.n * maxR(hz, R(1e-9)));
}

// Fraction of a facet's light that no other facet blocks: Smith's G2/G1 with height correlation; 0 where toLight is
// below the surface. Source: Heitz, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2),
// 2014, equation 99.
FN real facetWeight(IN(VisibleFacets) f, real3 toLight) {
  real c = dot3(toLight, f.n);
  real unblocked = (f.root + f.c) * c;
  real blocked = (smithRoot(c, f.alpha) - c) * f.c;
  return selectR(lessR(R(0.0), c), unblocked / maxR(unblocked + blocked, R(1e-30)), R(0.0));
}
