// Method `perfect-iterative`: `perfect-mirror` as a loop along the camera path.

#include "shaders/methods/colour_terms.h"

FN FresnelTerms termsFromReflectance(Reflectance red, Reflectance green, Reflectance blue) {
  FresnelTerms f;
  f.r = splat3(R(1.0));
  return f;
}

#include "shaders/methods/exact_terms.h"

#include "shaders/iterative/colour.h"
