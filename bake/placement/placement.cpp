#include "bake/placement/placement.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace malus::bake {

glm::dmat4 transformMatrix(const Transform& transform) {
  glm::dmat3 m(1.0);
  for (int axis = 0; axis < 3; ++axis) m[axis][axis] = transform.scale[axis];
  for (int axis = 0; axis < 3; ++axis) {
    const double a = transform.rotateDegrees[axis] * std::numbers::pi / 180;
    const double quarter = transform.rotateDegrees[axis] / 90;
    const bool exact = quarter == std::floor(quarter);
    const double c = exact ? std::round(std::cos(a)) : std::cos(a), s = exact ? std::round(std::sin(a)) : std::sin(a);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    glm::dmat3 turn(1.0);
    turn[u][u] = c, turn[u][v] = s, turn[v][u] = -s, turn[v][v] = c;
    m = turn * m;
  }
  glm::dmat4 result(m);
  result[3] = glm::dvec4(transform.translate, 1.0);
  return result;
}

prep::Mesh placed(const prep::Mesh& mesh, const glm::dmat4& worldFromObject) {
  const glm::dmat3 m(worldFromObject);
  const glm::dvec3 translation(worldFromObject[3]);
  const glm::dmat3 normalMatrix(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                                glm::cross(m[0], m[1]));  // det * inverse transpose
  const bool mirrors = glm::dot(m[0], glm::cross(m[1], m[2])) < 0;
  prep::Mesh result;
  result.positions = mesh.positions;
  result.normals = mesh.normals;
  result.triangles = mesh.triangles;
  for (glm::dvec3& p : result.positions) p = m * p + translation;
  for (glm::vec3& n : result.normals) {
    glm::dvec3 turned = normalMatrix * glm::dvec3(n);
    if (mirrors) turned = -turned;
    n = glm::vec3(glm::normalize(turned));
  }
  result.textureCoordinates = mesh.textureCoordinates;
  result.tangents = mesh.tangents;
  for (glm::vec4& t : result.tangents)
    t = glm::vec4(glm::vec3(glm::normalize(m * glm::dvec3(t))), mirrors ? -t.w : t.w);
  if (mirrors)
    for (glm::uvec3& t : result.triangles) std::swap(t.y, t.z);
  return result;
}

}  // namespace malus::bake
