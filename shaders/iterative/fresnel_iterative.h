// Method `fresnel-iterative`: `fresnel` as a loop along the camera path, without recursion and payload.
#include "shaders/methods/fresnel_terms.h"

#include "shaders/iterative/colour.h"
