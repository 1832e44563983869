// Samples of an area light, a triangle or a rectangle, as seen from a point.

struct AreaSample {
  real3 toLight;  // from the point to the sample, in metres
  real measure;   // solid angle in sr that samples stand for together: the mean of a function of the sample times it is
                  // the integral over the solid angle
};

// Below these solid angles a sample is uniform over the area, and its measure is the area times cosine / distance^2:
// the directions to the corners differ by too few steps of float, while the measure varies little over the light.
CONST_REAL(kPlanarTriangle, 1e-4);
CONST_REAL(kPlanarRectangle, 1e-3);

// Uniform over a planar triangle. Source: Turk, Generating Random Points in Triangles, Graphics Gems, 1990.
FN real3 trianglePointUniform(real3 corner, real3 edgeU, real3 edgeV, real u, real v) {
  real root = sqrtR(u);
  return corner + edgeU * (root * (R(1.0) - v)) + edgeV * (root * v);
}

FN real planarMeasure(real3 toLight, real3 across, real share) {
  real distanceSq = dot3(toLight, toLight);
  return absR(dot3(toLight, across)) * share / divisor(distanceSq * sqrtR(distanceSq));
}

// corner: from the point to a corner; edgeU, edgeV: edges from there; across: their cross product; u, v in [0, 1).
FN AreaSample sampleTriangleLight(real3 corner, real3 edgeU, real3 edgeV, real3 across, real u, real v) {
  SphericalTriangle t = sphericalTriangle(corner, edgeU, edgeV, across);
  real3 direction = sampleSphericalTriangle(t, u, v);
  // The direction meets the plane of the light.
  real slope = dot3(direction, across);
  real3 onPlane = direction * (absR(dot3(corner, across)) / divisor(absR(slope)));
  real3 planar = trianglePointUniform(corner, edgeU, edgeV, u, v);
  mask isPlanar = lessR(t.solidAngle, kPlanarTriangle);
  AreaSample s;
  s.toLight = select3(isPlanar, planar, onPlane);
  s.measure = selectR(isPlanar, planarMeasure(planar, across, R(0.5)), t.solidAngle);
  return s;
}

// The same of a rectangle; edgeU and edgeV are perpendicular.
FN AreaSample sampleRectangleLight(real3 corner, real3 edgeU, real3 edgeV, real3 across, real u, real v) {
  SphericalTriangle first = sphericalTriangle(corner, edgeU, edgeV, across);
  SphericalTriangle second = sphericalTriangle(corner + edgeU + edgeV, edgeU * R(-1.0), edgeV * R(-1.0), across);
  real solidAngle = first.solidAngle + second.solidAngle;
  real lengthU = sqrtR(dot3(edgeU, edgeU));
  real lengthV = sqrtR(dot3(edgeV, edgeV));
  real3 axisU = edgeU * (R(1.0) / divisor(lengthU));
  real3 axisV = edgeV * (R(1.0) / divisor(lengthV));
  real x0 = dot3(corner, axisU);
  real y0 = dot3(corner, axisV);
  real z = absR(dot3(corner, across)) / divisor(lengthU * lengthV);
  real x;
  real y;
  sampleSphericalRectangle(x0, x0 + lengthU, y0, y0 + lengthV, z, solidAngle, u, v, x, y);
  mask isPlanar = lessR(solidAngle, kPlanarRectangle);
  AreaSample s;
  s.toLight = corner + axisU * selectR(isPlanar, u * lengthU, x - x0) + axisV * selectR(isPlanar, v * lengthV, y - y0);
  s.measure = selectR(isPlanar, planarMeasure(s.toLight, across, R(1.0)), solidAngle);
  return s;
}

// cos and sin of the difference of two angles in [0, pi], or of 0 where it is negative.
FN real cosineOfRest(real cosA, real sinA, real cosB, real sinB) {
  return selectR(lessR(cosB, cosA), R(1.0), cosA * cosB + sinA * sinB);
}
FN real sineOfRest(real cosA, real sinA, real cosB, real sinB) {
  return selectR(lessR(cosB, cosA), R(0.0), sinA * cosB - cosA * sinB);
}
FN real sineOfCosine(real c) { return sqrtR(maxR((R(1.0) - c) * (R(1.0) + c), R(0.0))); }

// Estimate of the irradiance of a group of lights at a point p with normal n, by which samples are distributed over the
// lights: 0 only where none of them can contribute. The lights are within `radius` of `centre`; they emit about the
// unit vector axis, their normals are within an angle of cosine `spread` of it, -1: they emit to all sides. power: sum
// of radiance times area. Source: Conty Estevez and Kulla, Importance Sampling of Many Lights with Adaptive Tree
// Splitting, HPG 2018, in the form of Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition, 12.6.3.
FN real lightImportance(real3 p, real3 n, real3 centre, real radius, real3 axis, real spread, real power) {
  real3 to = centre - p;
  real distanceSq = dot3(to, to);
  real3 w = to * (R(1.0) / divisor(sqrtR(distanceSq)));
  real radiusSq = radius * radius;
  // Half the angle of the sphere around the lights; pi inside it.
  mask inside = lessEqualR(distanceSq, radiusSq);
  real sinBound = selectR(inside, R(0.0), minR(radius / divisor(sqrtR(distanceSq)), R(1.0)));
  real cosBound = selectR(inside, R(-1.0), sineOfCosine(sinBound));
  real cosAt = minR(maxR(dot3(n, w), R(-1.0)), R(1.0));
  real arriving = cosineOfRest(cosAt, sineOfCosine(cosAt), cosBound, sinBound);
  real cosFrom = minR(maxR(R(0.0) - dot3(axis, w), R(-1.0)), R(1.0));
  real sinFrom = sineOfCosine(cosFrom);
  real sinSpread = sineOfCosine(spread);
  real cosRest = cosineOfRest(cosFrom, sinFrom, spread, sinSpread);
  real leaving = cosineOfRest(cosRest, sineOfRest(cosFrom, sinFrom, spread, sinSpread), cosBound, sinBound);
  return power * maxR(arriving, R(0.0)) * maxR(leaving, R(0.0)) / divisor(maxR(distanceSq, radiusSq));
}

// Number k of a low-discrepancy sequence in [0, 1), k < 256. Source: van der Corput, Verteilungsfunktionen, 1935.
FN real radicalInverse(word k) {
  real sum = R(0.0);
  real digit = R(0.5);
  for (int bit = 0; bit < 8; ++bit) {
    sum = sum + selectR(hasBit(k, bit), digit, R(0.0));
    digit = digit * R(0.5);
  }
  return sum;
}

// Fraction of x >= 0, below 1.
FN real wrapUnit(real x) { return x - floorR(x); }
