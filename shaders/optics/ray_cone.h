// Cone around a ray, whose width on a surface is that of a pixel, or less: it chooses the level of textures. Source:
// T. Akenine-Moeller et al., "Improved Shader and Texture Level of Detail Using Ray Cones", Journal of Computer
// Graphics Techniques 10(1), 2021; the width is followed at each hit, and the spread grows with the curvature of
// mirrors.

struct RayCone {
  real width;   // at the ray's origin, in metres
  real spread;  // growth of the width per length of the ray; negative: the cone narrows
};

// The cone after a distance; behind its tip it widens.
FN RayCone coneAfter(IN(RayCone) cone, real distance) {
  real width = cone.width + cone.spread * distance;
  real side = signNotZero(width);
  RayCone after;
  after.width = width * side;
  after.spread = cone.spread * side;
  return after;
}

// The cone of a reflected ray. curvature: of the surface on the side of the ray, 1/m, positive where it bulges toward
// the ray; cosine: of incidence. A width w covers w / cosine of the surface, over which its normal turns by the
// curvature times that, and the mirror direction by twice as much (equation 3.2 and section 2 of the source).
FN RayCone reflectedCone(IN(RayCone) cone, real curvature, real cosine) {
  RayCone reflected;
  reflected.width = cone.width;
  reflected.spread = cone.spread + R(2.0) * curvature * cone.width / maxR(cosine, R(0.0625));
  return reflected;
}

// Curvature of a triangle with the corners p and normals n there: the mean over its edges of the change of the normal
// along the edge, over its length (section 4 of the source). normals: of any length, on the outside.
FN real edgeCurvature(real3 edge, real3 from, real3 to) {
  real3 change = normalize3(to) - normalize3(from);
  return dot3(change, edge) / divisor(dot3(edge, edge));
}
FN real triangleCurvature(real3 p0, real3 p1, real3 p2, real3 n0, real3 n1, real3 n2) {
  return (edgeCurvature(p1 - p0, n0, n1) + edgeCurvature(p2 - p1, n1, n2) + edgeCurvature(p0 - p2, n2, n0)) *
         (R(1.0) / R(3.0));
}

// The lower half of a path word has a cone: width and spread as floats without a sign, with two bits of mantissa, from
// 1e-12 to 7e6 and from 4e-9 to 8; bit 7 is the sign of the spread. Their relative error is at most 1/8, which is 0.17
// levels. The half 0 is the camera's ray, whose cone is known.
FN word coneBits(IN(RayCone) cone) {
  real width = minR(maxR(cone.width, R(1.0e-12)), R(7.0e6));
  real spread = minR(maxR(absR(cone.spread), R(4.0e-9)), R(8.0));
  // Rounded to the nearest: bit 20 is the first that is dropped. 344 = 4 (127 - 41) and 396 = 4 (127 - 28).
  word widthBits = addW(shiftRightW(addW(floatBits(width), 0x100000u), 21), 0xfffffea8u);
  word spreadBits = addW(shiftRightW(addW(floatBits(spread), 0x100000u), 21), 0xfffffe74u);
  word sign = shiftRightW(floatBits(cone.spread), 31);
  return orW(timesW(widthBits, 256u), orW(timesW(sign, 128u), spreadBits));
}
FN RayCone coneOfBits(word bits) {
  RayCone cone;
  cone.width = floatValue(timesW(addW(andW(shiftRightW(bits, 8), 0xffu), 344u), 0x200000u));
  real spread = floatValue(timesW(addW(andW(bits, 0x7fu), 396u), 0x200000u));
  cone.spread = selectR(hasBit(bits, 7), R(0.0) - spread, spread);
  return cone;
}

// The cone of a ray with a path word. cameraWidth, cameraSpread: of the camera's rays.
FN RayCone coneOfPath(word path, real cameraWidth, real cameraSpread) {
  RayCone cone = coneOfBits(path);
  mask first = equalW(lowHalf(path), 0u);
  cone.width = selectR(first, cameraWidth, cone.width);
  cone.spread = selectR(first, cameraSpread, cone.spread);
  return cone;
}
// The path word with a cone.
FN word pathWithCone(word path, IN(RayCone) cone) { return joinWord(coneBits(cone), highHalf(path)); }
