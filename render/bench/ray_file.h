// Files of logged rays; the format is described in cli.h.
#pragma once

#include <string>

#include "render/bench/ray_sets.h"

namespace malus::render {

// Throws Error as writeBeside() does.
void writeRays(const std::string& file, const RaySets::Set& set);

}  // namespace malus::render
