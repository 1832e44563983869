// What recursive methods and loops share of the surfaces, in the order of their dependence.
// clang-format off
#include "shaders/surfaces/hit.h"
#include "shaders/surfaces/check.h"
#include "shaders/surfaces/textures.h"
#include "shaders/surfaces/medium.h"
#include "shaders/surfaces/interface.h"
#include "shaders/surfaces/direct_light.h"
#include "shaders/surfaces/refraction.h"
#include "shaders/surfaces/polarizing_element_terms.h"
#include "shaders/surfaces/facet.h"
#include "shaders/surfaces/environment.h"
#include "shaders/surfaces/camera_colour.h"
