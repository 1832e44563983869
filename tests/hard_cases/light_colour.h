// Light of the methods that carry a colour, for handOverProbe.
FN SurfaceLight lightOf(real3 radiance, real3 polarization) { return lightUnpolarized(radiance); }
FN real3 lightTotal(SurfaceLight l) { return l.colour; }
