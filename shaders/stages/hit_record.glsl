// Payload of a ray whose hit the ray generation shader shades.
struct HitRecord {
  uint mesh;  // kNoMesh: the ray meets no surface
  uint triangle;
  vec2 barycentric;  // of the triangle's second and third corner
};

const uint kNoMesh = 0xffffffffu;
