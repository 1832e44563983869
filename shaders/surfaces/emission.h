// Emitters radiate on the side of their normal, unpolarized or, as a display does, linearly polarized. They reflect
// nothing.

// Radiance toward the camera, per colour; 0 on the other side.
FN real3 emission(IN(Hit) h, IN(Material) m) { return select3(h.outside, m.radiance, splat3(R(0.0))); }

// Normal of the plane whose s direction is the plane of the emitted field.
FN real3 emissionNormal(IN(Hit) h) { return cross3(h.face, materialExtra(h.material).axis); }
