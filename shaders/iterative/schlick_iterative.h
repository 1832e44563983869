// Method `schlick-iterative`: `schlick` as a loop over the eye path, without recursion and without payload.
#include "shaders/methods/schlick_terms.h"

#include "shaders/iterative/colour.h"
