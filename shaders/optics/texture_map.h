// Textures by texture coordinates, and materials whose numbers depend on them.

// A coordinate within one period of a texture, [0, 1] or, mirrored, [0, 2]: (0, 0) is the upper left corner of the
// image, (1, 1) the lower right. Ways to continue beyond the edges: glTF 2.0 Specification, section 3.8.3.
FN real wrapCoordinate(real u, mask isClamped, mask isMirrored) {
  real period = selectR(isMirrored, R(2.0), R(1.0));
  real turns = floorR(u * selectR(isMirrored, R(0.5), R(1.0)));
  return selectR(isClamped, clampUnit(u), u - turns * period);
}

// The column, or row, of a texel that is at most one texel outside of the period of wrapCoordinate. size: of the
// texture, in texels; the result is in [0, size - 1].
FN real wrapTexel(real i, real size, mask isClamped, mask isMirrored) {
  real last = size - R(1.0);
  real repeated = selectR(lessR(i, R(0.0)), i + size, selectR(lessR(last, i), i - size, i));
  real mirrored = selectR(lessR(last, i), last + size - i, i);
  mirrored = selectR(lessR(mirrored, R(0.0)), R(-1.0) - mirrored, mirrored);
  real wrapped = selectR(isMirrored, mirrored, repeated);
  wrapped = selectR(isClamped, i, wrapped);
  return minR(maxR(wrapped, R(0.0)), last);
}

// Index eta - i k of a conductor.
struct ConductorIndex {
  real eta;
  real k;
};

// The index whose reflectance at normal incidence, from vacuum, is r in [0, 1), with an edge tint g in [0, 1]:
//   n = g n_min + (1 - g) n_max,  n_min = (1 - r)/(1 + r),  n_max = (1 + sqrt r)/(1 - sqrt r)
// and k^2 = (r (n + 1)^2 - (n - 1)^2)/(1 - r), which is g (n_max - n_min)(n - 1/n_max), without a difference of nearly
// equal numbers. g = 0 is a dielectric, exactly k = 0. Source: O. Gulbrandsen, "Artist Friendly Metallic Fresnel",
// Journal of Computer Graphics Techniques 3(4), 2014.
FN ConductorIndex conductorIndex(real r, real g) {
  real root = sqrtR(r);
  real low = (R(1.0) - r) / (R(1.0) + r);
  real high = (R(1.0) + root) / (R(1.0) - root);
  ConductorIndex index;
  index.eta = low * g + high * (R(1.0) - g);
  index.k = sqrtR(maxR(g * (high - low) * (index.eta - R(1.0) / high), R(0.0)));
  return index;
}

// Bounds of the reflectance of conductorIndex in a texture: the index stays within that of a pack.
CONST_REAL(kLeastReflectance, 0.001);
CONST_REAL(kMostReflectance, 0.999);

// Normal that a normal map gives. normal: interpolated, unit; tangent: of any length, in the direction of growing u;
// handedness: +1 or -1 so that the bitangent is handedness cross(normal, tangent), in the direction of shrinking v;
// x, y, z: components of the map's normal along tangent, bitangent and normal. The tangent is projected perpendicular
// to the normal; a tangent along the normal does not change the normal. Not normalized. Source: glTF 2.0 Specification,
// sections 3.7.2.1 and 3.9.3.
FN real3 mappedNormal(real3 normal, real3 tangent, real handedness, real x, real y, real z) {
  real3 across = tangent - normal * dot3(normal, tangent);
  real lengthSq = dot3(across, across);
  mask usable = lessR(dot3(tangent, tangent) * R(1e-12), lengthSq);
  real3 t = across * (R(1.0) / sqrtR(selectR(usable, lengthSq, R(1.0))));
  real3 b = cross3(normal, t) * handedness;
  return select3(usable, t * x + b * y + normal * z, normal);
}

// Derivative of a triangle's points by the texture coordinate u, times the determinant of the coordinates' edges, and
// the sign of that determinant. e1, e2: edges from the first corner; (u1, v1), (u2, v2): the coordinates along them.
// The direction of the derivative is tangent sign(determinant); 0: the coordinates are degenerate. v points down in the
// image, so that the bitangent of the mesh, the direction of shrinking v, has the handedness -sign(determinant) for a
// triangle whose corners are counter-clockwise seen from outside.
struct TriangleTangent {
  real3 tangent;
  real determinant;
};
FN TriangleTangent triangleTangent(real3 e1, real3 e2, real u1, real v1, real u2, real v2) {
  TriangleTangent t;
  t.determinant = u1 * v2 - u2 * v1;
  t.tangent = (e1 * v2 - e2 * v1) * signNotZero(t.determinant);
  return t;
}

// Level of a texture's pyramid for a footprint of so many texels of level 0: the logarithm to base 2, piecewise linear
// between powers of two and 0 below one texel; at most 0.0861 below the logarithm. levels: of the pyramid.
FN real textureLevel(real texels, real levels) {
  real level = R(0.0);
  real scale = texels;
  for (int i = 0; i < 14; ++i) {
    mask larger = lessEqualR(R(2.0), scale);
    scale = selectR(larger, scale * R(0.5), scale);
    level = selectR(larger, level + R(1.0), level);
  }
  level = level + minR(maxR(scale - R(1.0), R(0.0)), R(1.0));
  return minR(level, levels - R(1.0));
}

// Width of a ray's cone on a triangle, in texture coordinates of a set (square root of areas): width over the cosine of
// incidence, times the square root of the ratio of the triangle's areas in coordinates and in space. Source:
// T. Akenine-Moeller et al., "Texture Level of Detail Strategies for Real-Time Ray Tracing", Ray Tracing Gems, 2019,
// chapter 20, equations 6 and 34.
FN real coneFootprint(real width, real cosine, real coordinateArea, real area) {
  real ratio = coordinateArea / divisor(area);
  return width * sqrtR(ratio) / maxR(cosine, R(1e-4));
}

// Texture coordinates of a point, sets 0 and 1.
struct TexturePoint {
  real u0;
  real v0;
  real u1;
  real v1;
};
FN TexturePoint texturePoint(real u0, real v0, real u1, real v1) {
  TexturePoint t;
  t.u0 = u0;
  t.v0 = v0;
  t.u1 = u1;
  t.v1 = v1;
  return t;
}

// Texture coordinates at a hit, and the width of the ray's cone there in the coordinates of each set.
struct TextureHit {
  TexturePoint at;
  real footprint0;
  real footprint1;
};
FN TextureHit noTextureHit() {
  TextureHit t;
  t.at = texturePoint(R(0.0), R(0.0), R(0.0), R(0.0));
  t.footprint0 = R(0.0);
  t.footprint1 = R(0.0);
  return t;
}

// Coordinates where a ray in direction d meets a triangle. e1, e2: edges from the first corner; b1, b2: barycentric
// coordinates; width: of the ray's cone there; t0, t1, t2: coordinates of the corners.
FN TextureHit textureHitOfTriangle(real3 d, real3 e1, real3 e2, real b1, real b2, real width, IN(TexturePoint) t0,
                                   IN(TexturePoint) t1, IN(TexturePoint) t2) {
  real b0 = R(1.0) - b1 - b2;
  real3 normal = cross3(e1, e2);
  real area = sqrtR(dot3(normal, normal));
  real cosine = absR(dot3(normal, d)) / divisor(area);
  real area0 = absR((t1.u0 - t0.u0) * (t2.v0 - t0.v0) - (t2.u0 - t0.u0) * (t1.v0 - t0.v0));
  real area1 = absR((t1.u1 - t0.u1) * (t2.v1 - t0.v1) - (t2.u1 - t0.u1) * (t1.v1 - t0.v1));
  TextureHit t;
  t.at = texturePoint(t0.u0 * b0 + t1.u0 * b1 + t2.u0 * b2, t0.v0 * b0 + t1.v0 * b1 + t2.v0 * b2,
                      t0.u1 * b0 + t1.u1 * b1 + t2.u1 * b2, t0.v1 * b0 + t1.v1 * b1 + t2.v1 * b2);
  t.footprint0 = coneFootprint(width, cosine, area0, area);
  t.footprint1 = coneFootprint(width, cosine, area1, area);
  return t;
}
