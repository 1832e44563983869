// Shared optics for C++, in float (malus::f32) and double (malus::f64). The files that all.h lists document each
// function with its units and source; CONVENTIONS.md fixes signs and frames.
#pragma once

#include <cmath>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "shaders/optics/language_begin.h"

namespace malus::f32 {
using real = float;
using real2 = glm::vec2;
using real3 = glm::vec3;
using mask = bool;
using word = std::uint32_t;
#include "shaders/optics/math.h"

#include "shaders/optics/all.h"
}  // namespace malus::f32

namespace malus::f64 {
using real = double;
using real2 = glm::dvec2;
using real3 = glm::dvec3;
using mask = bool;
using word = std::uint32_t;
#include "shaders/optics/math.h"

#include "shaders/optics/all.h"
}  // namespace malus::f64

#include "shaders/optics/language_end.h"
