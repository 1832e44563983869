// Removal of vertices without triangles. Keeps the order of the others.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

// Returns the dropped vertices.
Findings dropUnreferencedVertices(Mesh& mesh);

}  // namespace malus::prep
