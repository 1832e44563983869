// One call of every function of the optics, in the shared words: glsl_values_test.cpp runs it in C++ and, in a
// compute shader, on the device. Structs of numbers alone, so that their layout is the same.

struct Given {
  real c;
  real n1;
  real n2;
  real k2;
  real3 d;  // unit
  real3 n;  // unit
  real3 interpolated;
  real3 radiance;
  real cos2;
  real sin2;
};

struct Values {
  Reflectance dielectric;
  Transmittance transmittance;
  Reflectance conductor;
  real t;
  real tau;
  real total;    // 1: total reflection
  real matched;  // 1: no interface
  real schlick;
  real3 mirror;
  real3 refracted;
  real3 x;
  real3 y;
  real3 s;
  real turnCos;
  real turnSin;
  real cameraCos;
  real cameraSin;
  Stokes turned;
  Stokes reflected;
  real3 analysed;
  real3 lambert;
  real phong;
  real u;
  real v;
  real3 fromOctahedral;
  real irradiance;
  real3 shading;
  real3 error;
  real intersection;
  real3 inside;
  real3 origin;
  real3 camera;
  real3 cameraSample;
  real3 trianglePoint;
  real3 pointOnRay;
  real3 clamped;
  ImportanceVector turnedRow;
  ImportanceVector metRow;
  Film film;
  ThinGlass pane;
  ClearCoat glassCoat;
  ClearCoat metalCoat;
  real3 facet;
  real facetShare;
  real skyDegree;
  real skyPhase;
  real halved;    // back from 16 bits
  real fraction;  // as above
};

FN Values computeValues(Given g) {
  Values r;
  r.dielectric = dielectricReflectance(g.c, g.n1, g.n2);
  r.transmittance = dielectricTransmittance(g.c, g.n1, g.n2);
  r.conductor = conductorReflectance(g.c, g.n1, g.n2, g.k2);
  RefractionTerms f = refractionTerms(g.c, g.n1, g.n2);
  r.t = f.t;
  r.tau = f.tau;
  r.total = selectR(f.total, R(1.0), R(0.0));
  r.matched = selectR(f.matched, R(1.0), R(0.0));
  r.schlick = schlickReflectance(g.c, g.n1, g.n2, g.k2);
  real c = clampUnit(R(0.0) - dot3(g.d, g.n));
  r.mirror = mirrorDirection(g.d, g.n, c);
  r.refracted = refractedDirection(g.d, g.n, c, g.n1, g.n2);
  canonicalFrame(g.d, r.x, r.y);
  r.s = sDirection(g.d, g.n);
  frameRotation(r.s, r.x, r.y, r.turnCos, r.turnSin);
  cameraFrameRotation(g.d, g.n, r.cameraCos, r.cameraSin);
  Stokes light;
  light.s0 = g.radiance;
  light.s1 = g.radiance * R(0.5);
  light.s2 = g.radiance * R(-0.25);
  light.s3 = g.radiance * R(0.75);
  light = stokesAdd(light, stokesUnpolarized(g.radiance));
  r.turned = rotateStokes(light, g.cos2, g.sin2);
  r.reflected = stokesInterface(light, splat3(r.conductor.rs), splat3(r.conductor.rp), splat3(r.conductor.xRe),
                                splat3(r.conductor.xIm));
  r.analysed = analysed(light, R(0.5), R(0.5) * g.cos2, R(0.5) * g.sin2, g.c);
  r.lambert = lambertRadiance(g.radiance, g.interpolated, splat3(g.c));
  r.phong = phongLobe(g.d, g.n, 37);
  octahedralFromDirection(g.d, r.u, r.v);
  r.fromOctahedral = directionFromOctahedral(g.c, g.n1 * R(0.01));
  r.irradiance =
      irradiancePolynomial(g.n, g.radiance.x, g.radiance.y, g.radiance.z, g.d.x, g.d.y, g.d.z, g.c, g.k2, g.cos2);
  r.shading = shadingNormal(g.d, g.n, g.interpolated);
  r.error = hitPointError(g.d, g.n, g.interpolated, g.c, R(0.25), R(0.001));
  r.intersection = intersectionError(g.d, g.n, g.interpolated, g.radiance, R(0.001));
  r.inside = insideTriangle(g.radiance, g.d, g.n, g.interpolated, g.c, R(0.25), R(0.125), r.x, R(0.01));
  r.origin = rayOrigin(g.radiance, r.error, g.n, R(0.001));
  r.camera = cameraDirection(g.d, g.n, g.interpolated, R(0.5), R(0.25), g.c, g.cos2);
  r.cameraSample =
      cameraSampleDirection(g.d, g.n * R(1e-8), g.n, g.d * R(1e-8), g.interpolated, g.radiance * R(1e-8), g.c, g.cos2);
  r.trianglePoint = trianglePoint(g.d, g.n, g.interpolated, g.c, R(0.25));
  r.pointOnRay = pointOnRay(g.interpolated, g.radiance, g.d, g.n, R(1e6));
  r.clamped = max3(select3(lessR(g.c, R(0.5)), cross3(g.d, g.n), g.n), square(g.c) * kPi);
  ImportanceVector row;
  row.w = g.c;
  row.q = g.d.x;
  row.u = g.d.y;
  row.v = g.d.z;
  r.turnedRow = rotateImportance(row, g.cos2, g.sin2);
  r.metRow = applyInterfaceTransposed(row, r.conductor.rs, r.conductor.rp, r.conductor.xRe, r.conductor.xIm);
  word bits = joinWord(halfBits(g.k2), fractionBits(g.cos2));
  r.halved = halfValue(lowHalf(bits));
  r.fraction = fractionValue(highHalf(bits));
  // Denser than the first medium: GLSL has no exponential function in double for evanescent waves.
  r.film = thinFilm(g.c, R(1.0), R(1.0) + absR(g.cos2), R(1.25), R(1.0) + absR(g.sin2), g.k2);
  r.pane = thinGlass(g.c, R(1.0), R(1.0) + absR(g.sin2), R(1.0));
  r.glassCoat = coatOnDielectric(g.c, R(1.0), R(1.5), R(1.0) + absR(g.sin2), R(1.0), absR(g.cos2));
  r.metalCoat = coatOnConductor(g.c, R(1.0), R(1.5), R(1.0) + absR(g.sin2), g.k2, R(1.0));
  VisibleFacets visible = visibleFacets(g.d, g.n, R(0.25));
  r.facet = facetNormal(visible, R(0.5) * g.cos2, R(0.5) * g.sin2);
  r.facetShare = facetWeight(visible, g.interpolated);
  r.skyDegree = rayleighDegree(g.c, R(0.75));
  r.skyPhase = rayleighPhase(g.c);
  return r;
}
