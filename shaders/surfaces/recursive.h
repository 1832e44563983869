// The surfaces of a recursive method, in the order of their dependence; included after the method.
// clang-format off
#include "shaders/surfaces/steps.h"
#include "shaders/surfaces/check_sent.h"
#include "shaders/surfaces/send.h"
#include "shaders/surfaces/opaque.h"
#include "shaders/surfaces/lambert.h"
#include "shaders/surfaces/paint.h"
#include "shaders/surfaces/metal.h"
#include "shaders/surfaces/glass.h"
#if MALUS_EFFECT_POLARIZING_ELEMENT
#include "shaders/surfaces/polarizing_element.h"
#endif
#include "shaders/surfaces/emitter.h"
#include "shaders/surfaces/miss.h"
#include "shaders/surfaces/pixel.h"
