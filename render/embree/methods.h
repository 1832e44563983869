// Every build of every method of the Embree renderer: methods in the order of shaders/methods.def, the builds of a
// method from the fewest effects to all of them.
#pragma once

#include <vector>

#include "render/embree/packets/packets.h"
#include "render/embree/tile.h"

namespace malus::embree {

const std::vector<const Method*>& allMethods();
const std::vector<const PacketMethod*>& allPacketMethods();  // in the same order

}  // namespace malus::embree
