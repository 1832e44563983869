// Parts of the surfaces that recursive and iterative methods share, in the order of their dependence. Include this, or
// recursive.h or iterative/camera_path.h, which include it, and no single file of this folder. C++ includes it inside
// a tracer; GLSL after the scene's buffers.
// clang-format off
#include "shaders/surfaces/hit.h"
#include "shaders/surfaces/hooks.h"
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
