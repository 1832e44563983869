// Bilinear interpolation of four texels: (0, 0), (1, 0), (0, 1), (1, 1); fx and fy in [0, 1].
FN real3 bilinear(real3 t00, real3 t10, real3 t01, real3 t11, real fx, real fy) {
  real3 top = t00 * (R(1.0) - fx) + t10 * fx;
  real3 bottom = t01 * (R(1.0) - fx) + t11 * fx;
  return top * (R(1.0) - fy) + bottom * fy;
}

struct TexelPosition {
  real x;  // the upper left of the four texels, whole numbers
  real y;
  real fx;  // fractions
  real fy;
};

// Position of a direction in the octahedral environment map, which has `size` texels per side and a border of one
// texel that repeats what is across its edges.
FN TexelPosition environmentTexelPosition(real3 d, real size) {
  real u;
  real v;
  octahedralFromDirection(d, u, v);
  real x = u * size + R(0.5);
  real y = v * size + R(0.5);
  TexelPosition p;
  p.x = minR(floorR(x), size);
  p.y = minR(floorR(y), size);
  p.fx = x - p.x;
  p.fy = y - p.y;
  return p;
}

// Position of texture coordinates, repeated; (0, 0) is the upper left corner of the image, (1, 1) the lower right.
FN TexelPosition textureTexelPosition(real u, real v, real width, real height) {
  real x = (u - floorR(u)) * width - R(0.5);
  real y = (v - floorR(v)) * height - R(0.5);
  TexelPosition p;
  p.x = floorR(x);
  p.y = floorR(y);
  p.fx = x - p.x;
  p.fy = y - p.y;
  return p;
}
