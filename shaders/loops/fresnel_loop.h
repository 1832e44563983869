// Method `fresnel-loop`: `fresnel` as a loop over the eye path, without recursion and without payload.
#include "shaders/methods/fresnel_factors.h"

#include "shaders/loops/colour.h"
