// Microfacets of a rough surface, GGX distribution of roughness alpha, chosen among those that the eye sees. The mean
// over facets of F times facetWeight is the surface's reflection. toCamera, toLight, n: unit; alpha in (0, 1].

// Normal of the facet that (px, py), a point of the unit disk, stands for. Source: Heitz, Sampling the GGX Distribution
// of Visible Normals, JCGT 7(4), 2018. The disk's first axis lies across the plane of toCamera and n.
FN real3 facetNormal(real3 toCamera, real3 n, real alpha, real px, real py) {
  real3 across = sDirection(toCamera * R(-1.0), n);  // of the eye's plane of incidence
  real3 along = cross3(n, across);
  // Step 1: stretched so that the surface has roughness 1; the view there is (0, vy, vz).
  real y = alpha * dot3(toCamera, along);
  real z = maxR(dot3(toCamera, n), R(0.0));
  real inverse = R(1.0) / sqrtR(maxR(y * y + z * z, R(1e-30)));
  real vy = y * inverse;
  real vz = z * inverse;
  // Step 2: a point of the hemisphere that the view sees; the disk's axes are across and (0, -vz, vy).
  real s = R(0.5) * (R(1.0) + vz);
  real t1Sq = maxR(R(1.0) - px * px, R(0.0));
  real t2 = (R(1.0) - s) * sqrtR(t1Sq) + s * py;
  real t3 = sqrtR(maxR(t1Sq - t2 * t2, R(0.0)));
  real hy = t3 * vy - t2 * vz;
  real hz = t3 * vz + t2 * vy;
  // Step 3: back.
  return normalize3(across * (alpha * px) + along * (alpha * hy) + n * maxR(hz, R(1e-9)));
}

// Share of a facet's light that others do not hide: G2/G1 of Smith, correlated in height. Source: Heitz, Understanding
// the Masking-Shadowing Function, JCGT 3(2), 2014. 0 where the light goes below the surface.
FN real facetWeight(real3 toCamera, real3 toLight, real3 n, real alpha) {
  real o = maxR(dot3(toCamera, n), R(0.0));
  real i = dot3(toLight, n);
  real alphaSq = alpha * alpha;
  real ro = sqrtR(o * o + alphaSq * maxR(R(1.0) - o * o, R(0.0)));
  real ri = sqrtR(i * i + alphaSq * maxR(R(1.0) - i * i, R(0.0)));
  real seen = (ro + o) * i;
  real hidden = (ri - i) * o;
  return selectR(lessR(R(0.0), i), seen / maxR(seen + hidden, R(1e-30)), R(0.0));
}
