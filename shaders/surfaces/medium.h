// Absorption in the media between surfaces. Source: Beer-Lambert law.

// Transmittance over a distance in metres; absorption: coefficient in 1/m.
FN real3 transmittanceOver(real3 absorption, real distance) {
  return make3(attenuation(absorption.x * distance), attenuation(absorption.y * distance),
               attenuation(absorption.z * distance));
}

// Absorption coefficient of the medium on the side that is hit, in 1/m.
FN real3 mediumAbsorption(IN(Hit) h) {
  return select3(h.outside, materialExtra(h.material).outsideAbsorption, materialExtra(h.material).absorption);
}

// Transmittance of the medium between the point where the ray began and the hit.
FN real3 mediumTransmittance(IN(Hit) h) { return transmittanceOver(mediumAbsorption(h), h.travelled); }
