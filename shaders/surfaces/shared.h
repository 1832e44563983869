// Steps and drivers that recursive and iterative methods share, in the order of their dependence. Include recursive.h
// or iterative/camera_path.h, which include this, and no single file of this folder. C++ includes them inside a tracer,
// GLSL after the scene's buffers.
// clang-format off
#include "shaders/surfaces/steps.h"
#include "shaders/surfaces/surface_kinds.h"
#include "shaders/surfaces/check.h"
#include "shaders/surfaces/mesh_textures.h"
#include "shaders/surfaces/placed_texture.h"
#include "shaders/surfaces/textures.h"
#include "shaders/surfaces/environment.h"
#include "shaders/surfaces/shadows.h"
#include "shaders/surfaces/sampled_lights.h"
#include "shaders/surfaces/direct_light.h"
#include "shaders/surfaces/sample_direction.h"
#include "shaders/surfaces/camera_colour.h"
