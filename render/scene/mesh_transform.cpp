#include "render/scene/mesh_transform.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "bake/pack/instances.h"

namespace malus::render {

namespace {

glm::dmat3 absolute(const glm::dmat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

// A product as a cross product, with sums in place of differences.
glm::dvec3 absoluteCross(const glm::dvec3& a, const glm::dvec3& b) {
  return {a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x};
}

// Rounded up: a bound stays one.
glm::vec3 roundUp(const glm::dvec3& v) { return glm::vec3(v * (1 + 0x1p-20)); }

}  // namespace

gpu::MeshTransform makeMeshTransform(const glm::dmat3& linear, const glm::dvec3& rest) {
  gpu::MeshTransform t{};
  t.linearX = glm::vec3(linear[0]), t.linearY = glm::vec3(linear[1]), t.linearZ = glm::vec3(linear[2]);
  t.rest = glm::vec3(rest);
  const glm::dmat3 used{glm::dvec3(t.linearX), glm::dvec3(t.linearY), glm::dvec3(t.linearZ)};
  const bool isMirrored = pack::isMirrored(used);
  t.kind = isMirrored ? gpu::kMirrored : gpu::kPlaced;

  // Of the size 1, so that interpolated normals stay in the range of float.
  const glm::dmat3 cofactors = pack::cofactors(used);
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(cofactors[i][k]));
  const glm::dmat3 normals = cofactors * ((isMirrored ? -1 : 1) / largest);
  t.normalX = glm::vec3(normals[0]), t.normalY = glm::vec3(normals[1]), t.normalZ = glm::vec3(normals[2]);

  const glm::dmat3 a = absolute(used), spread = a * absolute(glm::inverse(used));
  t.spreadX = roundUp(spread[0]), t.spreadY = roundUp(spread[1]), t.spreadZ = roundUp(spread[2]);
  const double determinant = std::abs(glm::determinant(used));
  const glm::dmat3 inverse =
      glm::transpose(glm::dmat3(absoluteCross(a[1], a[2]), absoluteCross(a[2], a[0]), absoluteCross(a[0], a[1]))) *
      (1 / determinant);
  const double terms = glm::dot(a[0], absoluteCross(a[1], a[2])) / determinant;
  const glm::dvec3 size = a * glm::dvec3(1.0);
  t.extent = roundUp(4.0 * (a * (inverse * size)) + (6 * terms + 20) * size);
  return t;
}

gpu::MeshTransform unplacedMesh() {
  gpu::MeshTransform t{};
  t.linearX.x = t.linearY.y = t.linearZ.z = 1;
  t.kind = gpu::kUnplaced;
  return t;
}

}  // namespace malus::render
