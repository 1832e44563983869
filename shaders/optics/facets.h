// Microfacets of a rough surface: GGX distribution of roughness alpha in (0, 1], sampled among the facets visible from
// the camera. The mean over facets of their reflection times facetWeight is the surface's reflection. toCamera,
// toLight, n: unit vectors.

// Unit normal of the facet for a point (px, py) of the unit disk. The disk's first axis is perpendicular to toCamera
// and n. Source: Heitz, Sampling the GGX Distribution of Visible Normals, JCGT 7(4), 2018, sections 3 and 4.
FN real3 facetNormal(real3 toCamera, real3 n, real alpha, real px, real py) {
  real3 across = sDirection(toCamera * R(-1.0), n);  // perpendicular to the plane of incidence
  real3 along = cross3(n, across);
  // Stretch the view direction so that the surface has roughness 1: (0, vy, vz).
  real y = alpha * dot3(toCamera, along);
  real z = maxR(dot3(toCamera, n), R(0.0));
  real inverse = R(1.0) / sqrtR(maxR(y * y + z * z, R(1e-30)));
  real vy = y * inverse;
  real vz = z * inverse;
  // Project the disk's point onto the hemisphere visible from there; the disk's axes are across and (0, -vz, vy).
  real s = R(0.5) * (R(1.0) + vz);
  real t1Sq = maxR(R(1.0) - px * px, R(0.0));
  real t2 = (R(1.0) - s) * sqrtR(t1Sq) + s * py;
  real t3 = sqrtR(maxR(t1Sq - t2 * t2, R(0.0)));
  real hy = t3 * vy - t2 * vz;
  real hz = t3 * vz + t2 * vy;
  // Undo the stretch.
  return normalize3(across * (alpha * px) + along * (alpha * hy) + n * maxR(hz, R(1e-9)));
}

// Fraction of a facet's light that no other facet blocks: Smith's G2/G1 with height correlation; 0 where toLight is
// below the surface. Source: Heitz, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2),
// 2014, equation 99.
FN real facetWeight(real3 toCamera, real3 toLight, real3 n, real alpha) {
  real o = maxR(dot3(toCamera, n), R(0.0));
  real i = dot3(toLight, n);
  real alphaSq = alpha * alpha;
  real ro = sqrtR(o * o + alphaSq * maxR(R(1.0) - o * o, R(0.0)));
  real ri = sqrtR(i * i + alphaSq * maxR(R(1.0) - i * i, R(0.0)));
  real unblocked = (ro + o) * i;
  real blocked = (ri - i) * o;
  return selectR(lessR(R(0.0), i), unblocked / maxR(unblocked + blocked, R(1e-30)), R(0.0));
}
