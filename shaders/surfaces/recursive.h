// Surfaces of a recursive method, in the order of their dependence; included after the method.
// clang-format off
#include "shaders/surfaces/shared.h"
#include "shaders/surfaces/check_sent.h"
#include "shaders/surfaces/shade.h"
#include "shaders/surfaces/shade_surfaces.h"
#include "shaders/surfaces/shade_environment.h"
#include "shaders/surfaces/pixel.h"
