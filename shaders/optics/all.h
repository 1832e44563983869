// The optics in the order of their dependence. No include guard: every number type includes them anew.
// clang-format off
#include "shaders/optics/vector.h"
#include "shaders/optics/fresnel.h"
#include "shaders/optics/schlick.h"
#include "shaders/optics/directions.h"
#include "shaders/optics/frames.h"
#include "shaders/optics/stokes.h"
#include "shaders/optics/importance.h"
#include "shaders/optics/sources.h"
#include "shaders/optics/environment.h"
#include "shaders/optics/surface_point.h"
#include "shaders/optics/camera.h"
