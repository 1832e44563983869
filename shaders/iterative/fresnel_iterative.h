// Method `fresnel-iterative`: `fresnel` as a loop over the eye path, without recursion and without payload.
#include "shaders/methods/fresnel_terms.h"

#include "shaders/iterative/colour.h"
