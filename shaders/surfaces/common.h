// What recursive methods and loops share of the surfaces, in the order of their dependence.
// clang-format off
#include "shaders/surfaces/hit.h"
#include "shaders/surfaces/check.h"
#include "shaders/surfaces/direct_light.h"
#include "shaders/surfaces/glass_way.h"
#include "shaders/surfaces/surroundings.h"
