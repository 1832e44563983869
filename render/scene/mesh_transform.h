// Transforms of placed meshes, as the shaders read them.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "shaders/gpu/scene.h"

namespace malus::render {

// linear: from the mesh to the scene, with an inverse; rest: of the translation, beyond the origin of the mesh's
// record. The matrix of normals and the bounds of errors (placementError, shaders/optics/surface_point.h) are computed
// in double from the linear part that is rounded to float, which acceleration structures and shaders both use.
//
// extent, with A the linear part, C the matrix of its cofactors with absolute terms, d its determinant with absolute
// terms over its absolute value, and 1 the vector of ones: 4 |A| (C^T / |det A|) |A| 1, the rounding of an inverse that
// is computed by cofactors in single precision, and (6 d + 20) |A| 1, that of its determinant (6 d), of an intersection
// in the mesh (8 roundings of the largest difference of two coordinates) and of the transform of the triangle (4).
gpu::MeshTransform makeMeshTransform(const glm::dmat3& linear, const glm::dvec3& rest);

// Of a mesh without a transform.
gpu::MeshTransform unplacedMesh();

}  // namespace malus::render
