// Unit direction of the ray of a pinhole camera through an image position. right, up, forward: orthonormal camera axes;
// tanX, tanY: tangents of half the field of view; px, py: position in [0, 1], (0, 0) is the upper left corner.
FN real3 cameraDirection(real3 right, real3 up, real3 forward, real tanX, real tanY, real px, real py) {
  return normalize3(forward + right * ((R(2.0) * px - R(1.0)) * tanX) + up * ((R(1.0) - R(2.0) * py) * tanY));
}

// Unit direction of the ray through one sample of a camera that has columns and rows of samples. The direction before
// its normalization is first + column * columnStep + row * rowStep, each vector the sum of a coarse part and of a fine
// remainder. The coarse parts are multiples of one power of two, so that their sum is exact in float up to 2^24 samples
// per axis: the rounding of a camera axis alone would move every ray by a distance that curved mirrors magnify. Of an
// orthographic camera the same sum is the offset of the sample's ray from the camera's position.
FN real3 cameraSampleOffset(real3 first, real3 firstFine, real3 columnStep, real3 columnFine, real3 rowStep,
                            real3 rowFine, real column, real row) {
  real3 coarse = first + columnStep * column + rowStep * row;
  real3 fine = firstFine + columnFine * column + rowFine * row;
  return coarse + fine;
}

FN real3 cameraSampleDirection(real3 first, real3 firstFine, real3 columnStep, real3 columnFine, real3 rowStep,
                               real3 rowFine, real column, real row) {
  return normalize3(cameraSampleOffset(first, firstFine, columnStep, columnFine, rowStep, rowFine, column, row));
}

// Rotation from the canonical frame of a ray in direction d to its camera frame, whose x is cross(d, up): cosine and
// sine of twice the angle. The frame is taken per ray, so that angles are those seen along it (CONVENTIONS.md, Frames).
FN void cameraFrameRotation(real3 d, real3 up, OUT(real) cos2, OUT(real) sin2) {
  // x is perpendicular to up and to the ray, as the s direction of a surface with normal up is.
  canonicalRotation(d, sDirection(d, up), cos2, sin2);
}

// Intensity behind an analyser whose Mueller matrix has the first row (a0, a1, a2, a3).
FN real3 analysed(Stokes s, real a0, real a1, real a2, real a3) {
  return s.s0 * a0 + s.s1 * a1 + s.s2 * a2 + s.s3 * a3;
}
