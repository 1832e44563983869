// Interface terms of the methods with the exact unpolarized reflectance: the mean of R_s and R_p per colour.

#include "shaders/methods/colour_terms.h"

FN real meanReflectance(Reflectance f) { return R(0.5) * (f.rs + f.rp); }

FN FresnelTerms termsFromReflectance(Reflectance red, Reflectance green, Reflectance blue) {
  FresnelTerms f;
  f.r = make3(meanReflectance(red), meanReflectance(green), meanReflectance(blue));
  return f;
}

#include "shaders/methods/exact_terms.h"
