// Light of the methods that carry s and p powers, for handOverProbe.
FN Light lightOf(real3 radiance, real3 polarization) {
  Light l;
  l.s = radiance * ((R(1.0) + polarization.x) * R(0.5));
  l.p = radiance * ((R(1.0) - polarization.x) * R(0.5));
  return l;
}
FN real3 lightTotal(Light l) { return l.s + l.p; }
