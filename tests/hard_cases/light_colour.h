// Light of the methods that carry a colour, for handOverProbe.
FN Light lightOf(real3 radiance, real3 polarization) { return lightUnpolarized(radiance); }
FN real3 lightTotal(Light l) { return l.colour; }
