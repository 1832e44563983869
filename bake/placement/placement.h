// Placement of meshes: transforms as matrices, and meshes transformed by them, in double precision.
#pragma once

#include <glm/mat4x4.hpp>

#include "bake/scene_file/scene_file.h"
#include "meshprep/mesh.h"

namespace malus::bake {

// Scale, then rotations about x, y and z, then translation. Quarter rotations are exact, so that meshes that touch
// still touch.
glm::dmat4 transformMatrix(const Transform& transform);

// The mesh in world space; worldFromObject is affine and regular. A mirroring one flips the faces, so that outside
// stays outside. The result has positions, normals and triangles only.
prep::Mesh placed(const prep::Mesh& mesh, const glm::dmat4& worldFromObject);

}  // namespace malus::bake
