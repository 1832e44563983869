// Surfaces of a recursive method, in the order of their dependence; included after the method. A variant that traces
// from its ray generation shader alone (MALUS_STACK_SIZE) replaces the recursion by a stack.
// clang-format off
#include "shaders/surfaces/shared.h"
#include "shaders/surfaces/check_sent.h"
#include "shaders/surfaces/sent_light.h"
#include "shaders/surfaces/shade_sources.h"
#include "shaders/surfaces/shade_environment.h"
#ifdef MALUS_STACK_SIZE
#include "shaders/surfaces/shade_stack.h"
#else
#include "shaders/surfaces/shade.h"
#endif
#include "shaders/surfaces/pixel.h"
