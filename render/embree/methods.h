// Every method of the Embree renderer, in the order of the list in shaders/CMakeLists.txt.
#pragma once

#include <vector>

#include "render/embree/tile.h"

namespace malus::embree {

const std::vector<const Method*>& allMethods();

}  // namespace malus::embree
