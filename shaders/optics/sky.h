// Light of a clear sky, by single Rayleigh scattering. Light from direction d is polarized perpendicular to the plane
// of d and the sun: its s direction is sDirection(d, sun). cosine: of the angle between d and the direction toward the
// sun. Source: Coulson, Polarization and Intensity of Light in the Atmosphere, 1988.

// Degree of linear polarization, maximum (1 - cos^2)/(1 + cos^2). maximum: the degree at 90 degrees from the sun, 1 in
// theory, about 0.8 in a clear sky.
FN real rayleighDegree(real cosine, real maximum) {
  real cosSq = cosine * cosine;
  return maximum * maxR(R(1.0) - cosSq, R(0.0)) / (R(1.0) + cosSq);
}
// Phase function 3/4 (1 + cos^2): radiance relative to its mean over all directions.
FN real rayleighPhase(real cosine) { return R(0.75) * (R(1.0) + cosine * cosine); }
