// Every build of every method of the Embree renderer: methods in the order of the list in shaders/CMakeLists.txt,
// builds from the smallest on.
#pragma once

#include <vector>

#include "render/embree/tile.h"

namespace malus::embree {

const std::vector<const Method*>& allMethods();

}  // namespace malus::embree
