// Steps: what a surface does with one ray, without sending another. They keep the rules of the shared language
// (shaders/optics/CONVENTIONS.md), so that a build on SIMD lanes runs them too. A renderer's drivers (shared.h,
// recursive.h, iterative/camera_path.h) branch and send the rays. Steps read material data by hooks.h alone.
// clang-format off
#include "shaders/surfaces/effects.h"
#include "shaders/surfaces/path_word.h"
#include "shaders/surfaces/hit.h"
#include "shaders/surfaces/placed_triangle.h"
#include "shaders/surfaces/hooks.h"
#include "shaders/surfaces/medium.h"
#include "shaders/surfaces/interface_terms.h"
#include "shaders/surfaces/clear_coat.h"
#include "shaders/surfaces/scattering.h"
#include "shaders/surfaces/opaque.h"
#include "shaders/surfaces/glass.h"
#include "shaders/surfaces/polarizing_element.h"
#include "shaders/surfaces/thin_glass.h"
#include "shaders/surfaces/facet.h"
#include "shaders/surfaces/emission.h"
#include "shaders/surfaces/point_light.h"
#include "shaders/surfaces/light_row.h"
#include "shaders/surfaces/bilinear.h"
