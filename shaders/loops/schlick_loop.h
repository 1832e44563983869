// Method `schlick-loop`: `schlick` as a loop over the eye path, without recursion and without payload.
#include "shaders/methods/schlick_factors.h"

#include "shaders/loops/colour.h"
