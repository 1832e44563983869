// Interface terms of the methods with Schlick's approximation: the reflectance per colour.

#include "shaders/methods/colour_terms.h"

FN FresnelTerms dielectricTerms(real c, real n1, real n2, real difference) {
  FresnelTerms f;
  f.r = splat3(schlickReflectanceWith(c, n1, n2, R(0.0), difference));
  return f;
}
FN FresnelTerms conductorTerms(real c, real n1, real3 n2, real3 k2, real3 difference) {
  FresnelTerms f;
  f.r = make3(schlickReflectanceWith(c, n1, n2.x, k2.x, difference.x),
              schlickReflectanceWith(c, n1, n2.y, k2.y, difference.y),
              schlickReflectanceWith(c, n1, n2.z, k2.z, difference.z));
  return f;
}
// For what has no Schlick form (polarizing elements): the mean.
FN FresnelTerms termsFromReflectance(Reflectance red, Reflectance green, Reflectance blue) {
  FresnelTerms f;
  f.r = make3(red.rs + red.rp, green.rs + green.rp, blue.rs + blue.rp) * R(0.5);
  return f;
}
// Schlick's curve from the film's reflectance at normal incidence. A film that reflects nothing there is an interface
// still; only without any contrast of the indices there is none.
FN real schlickFilm(real c, FilmLayers l) {
  real contrast = absR(l.filmStep) + absR(l.baseStep) + l.k3;
  real f0 = filmResponse(R(1.0), l).reflected.rs;
  return schlickCurve(c, l.n1, l.n3, l.k3, l.baseStep, f0, equalR(contrast, R(0.0)));
}
FN FresnelTerms filmTerms(real c, FilmLayers red, FilmLayers green, FilmLayers blue) {
  FresnelTerms f;
  f.r = make3(schlickFilm(c, red), schlickFilm(c, green), schlickFilm(c, blue));
  return f;
}
FN FresnelTerms filmTransmissionTerms(real c, FilmLayers red, FilmLayers green, FilmLayers blue) {
  FresnelTerms f = filmTerms(c, red, green, blue);
  f.r = splat3(R(1.0)) - f.r;
  return f;
}
