// Normals by the smoothing groups of the file: an edge is smooth where its two triangles are of the same group, and
// that is not 0 (piece_normals.h). The angle between them does not matter.
// Source: Wavefront Technologies, "Object Files (.obj)", Advanced Visualizer Manual, appendix B1, "s group_number".
#pragma once

#include "meshprep/normals/piece_normals.h"

namespace malus::prep {

// mesh.smoothingGroups must be there.
NormalCounts addSmoothingNormals(Mesh& mesh);

}  // namespace malus::prep
