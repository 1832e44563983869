#include "render/scene/mesh_transform.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "shaders/optics/optics.h"

namespace malus::render {
namespace {

glm::dmat3 linearPart(const gpu::MeshTransform& t) {
  return {glm::dvec3(t.linearX), glm::dvec3(t.linearY), glm::dvec3(t.linearZ)};
}

TEST(MeshTransform, NormalsArePerpendicularToTheImageAndOutward) {
  const glm::dmat3 linear({1, 0.5, 0}, {0.25, -2, 0}, {0, 0.125, 1e-2});
  for (const double mirror : {1.0, -1.0}) {
    const gpu::MeshTransform t = makeMeshTransform(linear * mirror, {0, 0, 0});
    EXPECT_EQ(t.kind, mirror > 0 ? gpu::kMirrored : gpu::kPlaced);  // the determinant of `linear` is negative
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 0.5, -0.7)), tangent = glm::cross(n, glm::dvec3(1, 2, 3));
    const glm::dvec3 image = glm::dvec3(t.normalX) * n.x + glm::dvec3(t.normalY) * n.y + glm::dvec3(t.normalZ) * n.z;
    EXPECT_NEAR(glm::dot(glm::normalize(image), glm::normalize(linearPart(t) * tangent)), 0, 1e-6);
    EXPECT_GT(glm::dot(image, linearPart(t) * n), 0);
  }
}

TEST(MeshTransform, AnUnplacedMeshKeepsItsPoints) {
  EXPECT_EQ(unplacedMesh().kind, gpu::kUnplaced);
  EXPECT_EQ(linearPart(unplacedMesh()), glm::dmat3(1.0));
}

// The transform of a ray's origin to the mesh, as an acceleration structure computes it in single precision: an inverse
// by cofactors, applied to the translation once and to the point.
glm::vec3 toMesh(const glm::mat3& linear, const glm::vec3& translation, const glm::vec3& o) {
  const glm::mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
  const float determinant = glm::dot(linear[0], cofactors[0]);
  const glm::mat3 inverse = glm::transpose(cofactors) * (1 / determinant);
  return inverse * o + -(inverse * translation);
}

TEST(MeshTransform, BoundsHoldForTransformsOfOrigins) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  double tightest = 0;
  for (int i = 0; i < 20000; ++i) {
    glm::dmat3 linear;
    for (int column = 0; column < 3; ++column) linear[column] = {any(random), any(random), any(random)};
    if (std::abs(glm::determinant(linear)) < 1e-3) continue;
    const double scale = std::exp2(10 * any(random)), distance = i % 2 == 0 ? 1 : 1e5;
    linear *= scale;
    const glm::vec3 translation(glm::dvec3(any(random), any(random), any(random)) * distance);
    const glm::dvec3 p(any(random), any(random), any(random));  // in the mesh
    const gpu::MeshTransform t = makeMeshTransform(linear, {0, 0, 0});
    const glm::mat3 used{t.linearX, t.linearY, t.linearZ};
    const glm::vec3 o(linearPart(t) * p + glm::dvec3(translation));
    const glm::dvec3 back = linearPart(t) * glm::dvec3(toMesh(used, translation, o)) + glm::dvec3(translation),
                     error = glm::abs(back - glm::dvec3(o));
    const glm::dvec3 bound = f64::placementError(glm::dvec3(t.spreadX), glm::dvec3(t.spreadY), glm::dvec3(t.spreadZ),
                                                 glm::dvec3(t.extent), glm::dvec3(o), 1, 0x1p-24) +
                             f64::originError(glm::dvec3(o), 0x1p-24);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(error[axis], bound[axis]) << i << ", axis " << axis;
      tightest = std::max(tightest, error[axis] / bound[axis]);
    }
  }
  EXPECT_GT(tightest, 0.02);  // not orders of magnitude too wide
}

}  // namespace
}  // namespace malus::render
