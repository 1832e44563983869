// Pinhole camera. right, up, forward: orthonormal; tanX, tanY: tangents of half the field of view.
// px, py: position in the picture in [0, 1], (0, 0) the upper left corner.
FN real3 cameraDirection(real3 right, real3 up, real3 forward, real tanX, real tanY, real px, real py) {
  return normalize3(forward + right * ((R(2.0) * px - R(1.0)) * tanX) + up * ((R(1.0) - R(2.0) * py) * tanY));
}

// The camera's frame of a ray: x = cross(d, up), per ray, so that angles are those seen along that ray.
FN void cameraFrameRotation(real3 d, real3 up, OUT(real) cos2, OUT(real) sin2) {
  // Up takes the part of a normal: the camera's x is perpendicular to it and to the ray.
  canonicalRotation(d, sDirection(d, up), cos2, sin2);
}

// Intensity behind an analyser with row (a0, a1, a2, a3) of its Mueller matrix.
FN real3 analysed(Stokes s, real a0, real a1, real a2, real a3) {
  return s.s0 * a0 + s.s1 * a1 + s.s2 * a2 + s.s3 * a3;
}
