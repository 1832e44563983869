// Light of a point light that a surface scatters toward the camera: diffuse light and highlight.

// Radiance of a Lambert surface, albedo/pi E T. irradiance E: power per area on the surface, cosine included; entering
// T: transmittance of the interface above it at the light's angle, 1 without an interface.
FN real3 lambertRadiance(real3 albedo, real3 irradiance, real3 entering) {
  return albedo * irradiance * entering * (R(1.0) / kPi);
}

// Normalized Phong lobe in 1/sr: (m + 1)/(2 pi) cos^m of the angle between the mirror direction and the light. Source:
// Lafortune and Willems, Using the Modified Phong Reflectance Model for Physically Based Rendering, report CW 197,
// KU Leuven, 1994.
FN real phongLobe(real3 mirror, real3 toLight, word exponent) {
  real c = maxR(dot3(mirror, toLight), R(0.0));
  return (realOfWord(exponent) + R(1.0)) / (R(2.0) * kPi) * powInteger(c, exponent);
}
