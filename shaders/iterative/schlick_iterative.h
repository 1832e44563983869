// Method `schlick-iterative`: `schlick` as a loop along the camera path, without recursion and payload.
#include "shaders/methods/schlick_terms.h"

#include "shaders/iterative/colour.h"
