// Emitters radiate on the side of their normal or on both sides, unpolarized or, as a display does, linearly polarized.
// They reflect nothing.

// Radiance toward the camera, per colour.
FN real3 emission(IN(Hit) h, IN(Material) m) { return select3(h.outside, m.radiance, m.albedo); }

// Normal of the plane whose s direction is the plane of the emitted field.
FN real3 emissionNormal(IN(Hit) h) { return cross3(h.face, materialExtra(h.material).axis); }
