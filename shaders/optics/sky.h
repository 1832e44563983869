// Light of a clear sky, by single Rayleigh scattering: from direction d it is polarized across the plane of d and the
// sun (its s direction is sDirection(d, sun)). Source: Coulson, Polarization and Intensity of Light in the Atmosphere,
// 1988. cosine: of the angle between d and the direction toward the sun.

// Degree of linear polarization; most: at 90 degrees from the sun (1 in theory, about 0.8 in a clear sky).
FN real rayleighDegree(real cosine, real most) {
  real cosSq = cosine * cosine;
  return most * maxR(R(1.0) - cosSq, R(0.0)) / (R(1.0) + cosSq);
}
// Phase function: radiance against its mean over all directions.
FN real rayleighPhase(real cosine) { return R(0.75) * (R(1.0) + cosine * cosine); }
