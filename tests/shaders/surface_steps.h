// The steps of the surfaces (shaders/surfaces/steps.h) as structs, for the scalar build and the two-lane type. Included
// in a namespace that has the optics, the methods and shaders/gpu/material.h, with every MALUS_EFFECT_ macro 1. No
// include guard.
struct SchlickSteps : Method_schlick {
#include "tests/shaders/surface_steps_members.h"
};
struct PowersSteps : Method_sp {
#include "tests/shaders/surface_steps_members.h"
};
struct StokesSteps : Method_stokes {
#include "tests/shaders/surface_steps_members.h"
};
struct FresnelPathSteps {
#include "shaders/iterative/fresnel_iterative.h"
#include "tests/shaders/surface_steps_members.h"

#include "shaders/iterative/path.h"
};
struct ImportancePathSteps {
#include "shaders/iterative/importance.h"
#include "tests/shaders/surface_steps_members.h"

#include "shaders/iterative/path.h"
};
