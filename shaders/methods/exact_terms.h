// FresnelTerms of the methods that use Fresnel's equations: from the exact reflectance of each colour.
// Included after a method's FresnelTerms and its termsFromReflectance(red, green, blue).

// difference: n2 - n1 (shaders/optics/fresnel.h).
FN FresnelTerms dielectricTerms(real c, real n1, real n2, real difference) {
  Reflectance r = reflectanceFromTerms(c, refractionTermsWith(c, n1, n2, difference));
  return termsFromReflectance(r, r, r);
}
FN_TERMS FresnelTerms conductorTerms(real c, real n1, real3 n2, real3 k2, real3 difference) {
  return termsFromReflectance(conductorReflectanceWith(c, n1, n2.x, k2.x, difference.x),
                              conductorReflectanceWith(c, n1, n2.y, k2.y, difference.y),
                              conductorReflectanceWith(c, n1, n2.z, k2.z, difference.z));
}
// Under a thin film, given per colour.
FN FresnelTerms filmTerms(real c, FilmLayers red, FilmLayers green, FilmLayers blue) {
  return termsFromReflectance(filmResponse(c, red).reflected, filmResponse(c, green).reflected,
                              filmResponse(c, blue).reflected);
}
// Transmission through the film into a dielectric. Applied as a reflection is, because it shifts phases too.
FN FresnelTerms filmTransmissionTerms(real c, FilmLayers red, FilmLayers green, FilmLayers blue) {
  return termsFromReflectance(filmResponse(c, red).through, filmResponse(c, green).through,
                              filmResponse(c, blue).through);
}
