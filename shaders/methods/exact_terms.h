// FresnelTerms of the methods that use Fresnel's equations: from the exact reflectance of each colour.
// Included after a method's FresnelTerms and its termsFromReflectance(red, green, blue).

FN FresnelTerms dielectricTerms(real c, real n1, real n2) {
  Reflectance r = dielectricReflectance(c, n1, n2);
  return termsFromReflectance(r, r, r);
}
FN FresnelTerms conductorTerms(real c, real n1, real3 n2, real3 k2) {
  return termsFromReflectance(conductorReflectance(c, n1, n2.x, k2.x), conductorReflectance(c, n1, n2.y, k2.y),
                              conductorReflectance(c, n1, n2.z, k2.z));
}
// Under a thin film of index nf; turns: film.h.
FN FresnelTerms filmTerms(real c, real n1, real3 nf, real3 turns, real3 n3, real3 k3) {
  return termsFromReflectance(thinFilm(c, n1, nf.x, turns.x, n3.x, k3.x).reflected,
                              thinFilm(c, n1, nf.y, turns.y, n3.y, k3.y).reflected,
                              thinFilm(c, n1, nf.z, turns.z, n3.z, k3.z).reflected);
}
// Transmission through the film into a dielectric. Applied as a reflection is, because it shifts phases too.
FN FresnelTerms filmTransmissionTerms(real c, real n1, real3 nf, real3 turns, real3 n3) {
  return termsFromReflectance(thinFilm(c, n1, nf.x, turns.x, n3.x, R(0.0)).through,
                              thinFilm(c, n1, nf.y, turns.y, n3.y, R(0.0)).through,
                              thinFilm(c, n1, nf.z, turns.z, n3.z, R(0.0)).through);
}
