// Interface terms of the methods with Schlick's approximation: the reflectance per colour.

#include "shaders/methods/colour_terms.h"

FN FresnelTerms dielectricTerms(real c, real n1, real n2) {
  FresnelTerms f;
  f.r = splat3(schlickReflectance(c, n1, n2, R(0.0)));
  return f;
}
FN FresnelTerms conductorTerms(real c, real n1, real3 n2, real3 k2) {
  FresnelTerms f;
  f.r = make3(schlickReflectance(c, n1, n2.x, k2.x), schlickReflectance(c, n1, n2.y, k2.y),
              schlickReflectance(c, n1, n2.z, k2.z));
  return f;
}
// For what has no Schlick form (polarizing elements): the mean.
FN FresnelTerms termsFromReflectance(Reflectance red, Reflectance green, Reflectance blue) {
  FresnelTerms f;
  f.r = make3(red.rs + red.rp, green.rs + green.rp, blue.rs + blue.rp) * R(0.5);
  return f;
}
// Schlick's curve from the film's reflectance at normal incidence.
FN FresnelTerms filmTerms(real c, real n1, real3 nf, real3 turns, real3 n3, real3 k3) {
  FresnelTerms f;
  f.r = make3(schlickCurve(c, n1, n3.x, k3.x, thinFilm(R(1.0), n1, nf.x, turns.x, n3.x, k3.x).reflected.rs),
              schlickCurve(c, n1, n3.y, k3.y, thinFilm(R(1.0), n1, nf.y, turns.y, n3.y, k3.y).reflected.rs),
              schlickCurve(c, n1, n3.z, k3.z, thinFilm(R(1.0), n1, nf.z, turns.z, n3.z, k3.z).reflected.rs));
  return f;
}
FN FresnelTerms filmTransmissionTerms(real c, real n1, real3 nf, real3 turns, real3 n3) {
  FresnelTerms f = filmTerms(c, n1, nf, turns, n3, splat3(R(0.0)));
  f.r = splat3(R(1.0)) - f.r;
  return f;
}
