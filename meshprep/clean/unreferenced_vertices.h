// Drops vertices that no triangle names. Order of the others is kept.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

// Returns those that were dropped.
Findings dropUnreferencedVertices(Mesh& mesh);

}  // namespace malus::prep
