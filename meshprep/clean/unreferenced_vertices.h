// Drops vertices that no triangle names. Order of the others is kept.
#pragma once

#include <cstdint>

#include "meshprep/mesh.h"

namespace malus::prep {

// Returns how many were dropped.
std::uint64_t dropUnreferencedVertices(Mesh& mesh);

}  // namespace malus::prep
