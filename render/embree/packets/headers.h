// Headers that the packet tracers need besides Highway, included before any code of a particular instruction set:
// functions of these headers must not be compiled for one.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <glm/gtc/packing.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "render/embree/counting_sort.h"
#include "render/embree/packets/packets.h"
#include "render/embree/tile_effects.h"
#include "shaders/gpu/constants.h"
#include "shaders/gpu/scene.h"
