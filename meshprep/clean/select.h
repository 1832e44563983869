// Edits of a mesh's lists of triangles and vertices that keep all attributes consistent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "meshprep/mesh.h"

namespace malus::prep {

inline glm::dvec3 centroid(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3& t = mesh.triangles[triangle];
  return (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0;
}

// Removes the triangles for which keep(i) returns false. Calls it once per triangle, in order.
template <class Keep>
void keepTriangles(Mesh& mesh, Keep keep) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!keep(i)) continue;
    if (kept == i) {  // nothing is removed so far
      ++kept;
      continue;
    }
    mesh.triangles[kept] = mesh.triangles[i];
    if (!mesh.sourceFaces.empty()) mesh.sourceFaces[kept] = mesh.sourceFaces[i];
    if (!mesh.sourceCorners.empty()) mesh.sourceCorners[kept] = mesh.sourceCorners[i];
    if (!mesh.flipped.empty()) mesh.flipped[kept] = mesh.flipped[i];
    if (!mesh.smoothingGroups.empty()) mesh.smoothingGroups[kept] = mesh.smoothingGroups[i];
    if (!mesh.cornerNormals.empty())
      for (std::size_t corner = 0; corner < 3; ++corner)
        mesh.cornerNormals[3 * kept + corner] = mesh.cornerNormals[3 * i + corner];
    if (!mesh.cornerTextures.empty())
      for (std::size_t corner = 0; corner < 3; ++corner)
        mesh.cornerTextures[3 * kept + corner] = mesh.cornerTextures[3 * i + corner];
    ++kept;
  }
  if (kept == mesh.triangles.size()) return;
  mesh.triangles.resize(kept);
  if (!mesh.sourceFaces.empty()) mesh.sourceFaces.resize(kept);
  if (!mesh.sourceCorners.empty()) mesh.sourceCorners.resize(kept);
  if (!mesh.flipped.empty()) mesh.flipped.resize(kept);
  if (!mesh.smoothingGroups.empty()) mesh.smoothingGroups.resize(kept);
  if (!mesh.cornerNormals.empty()) mesh.cornerNormals.resize(3 * kept);
  if (!mesh.cornerTextures.empty()) mesh.cornerTextures.resize(3 * kept);
}

// Texture attributes at this fraction of the way from a to b. The sign of the bitangent is that of a.
inline CornerTexture interpolated(const CornerTexture& a, const CornerTexture& b, double fraction) {
  CornerTexture result = a;
  const auto t = static_cast<float>(fraction);
  for (std::size_t set = 0; set < result.coordinates.size(); ++set)
    result.coordinates[set] += t * (b.coordinates[set] - a.coordinates[set]);
  const glm::vec3 tangent = glm::vec3(a.tangent) + t * (glm::vec3(b.tangent) - glm::vec3(a.tangent));
  result.tangent = glm::vec4(tangent, a.tangent.w);
  result.isMissing = a.isMissing || b.isMissing;
  return result;
}

// Appends a triangle of the same source face as triangle `like`. Its corners have no normals and no texture attributes.
inline void addTriangle(Mesh& mesh, const glm::uvec3& triangle, std::size_t like) {
  const glm::uvec3 corners = mesh.sourceVertices.empty()
                                 ? triangle
                                 : glm::uvec3(mesh.sourceVertices[triangle.x], mesh.sourceVertices[triangle.y],
                                              mesh.sourceVertices[triangle.z]);
  mesh.triangles.push_back(triangle);
  if (!mesh.sourceFaces.empty()) mesh.sourceFaces.push_back(mesh.sourceFaces[like]);
  if (!mesh.sourceCorners.empty()) mesh.sourceCorners.push_back(corners);
  if (!mesh.flipped.empty()) mesh.flipped.push_back(mesh.flipped[like]);
  if (!mesh.smoothingGroups.empty()) mesh.smoothingGroups.push_back(mesh.smoothingGroups[like]);
  if (!mesh.cornerNormals.empty()) mesh.cornerNormals.insert(mesh.cornerNormals.end(), 3, glm::vec3(0));
  if (!mesh.cornerTextures.empty()) {
    CornerTexture missing;
    missing.isMissing = true;
    mesh.cornerTextures.insert(mesh.cornerTextures.end(), 3, missing);
  }
}

// Flips a triangle and keeps its first vertex.
inline void flipTriangle(Mesh& mesh, std::size_t i) {
  std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
  if (!mesh.flipped.empty()) mesh.flipped[i] = mesh.flipped[i] == 0 ? 1 : 0;
  if (!mesh.sourceCorners.empty()) std::swap(mesh.sourceCorners[i].y, mesh.sourceCorners[i].z);
  if (!mesh.cornerNormals.empty()) std::swap(mesh.cornerNormals[3 * i + 1], mesh.cornerNormals[3 * i + 2]);
  if (!mesh.cornerTextures.empty()) std::swap(mesh.cornerTextures[3 * i + 1], mesh.cornerTextures[3 * i + 2]);
}

// Returns the values of these numbers.
template <class T>
std::vector<T> selected(const std::vector<T>& values, const std::vector<std::uint32_t>& numbers) {
  std::vector<T> result;
  result.reserve(numbers.size());
  for (const std::uint32_t i : numbers) result.push_back(values[i]);
  return result;
}

// Replaces the vertices by those of `from`, one old index per new vertex, and old indices i of triangles by
// newIndex[i].
inline void selectVertices(Mesh& mesh, const std::vector<std::uint32_t>& from,
                           const std::vector<std::uint32_t>& newIndex) {
  const auto take = [&](auto& values) {
    if (!values.empty()) values = selected(values, from);
  };
  take(mesh.positions);
  take(mesh.normals);
  take(mesh.sourceVertices);
  for (glm::uvec3& t : mesh.triangles) t = {newIndex[t.x], newIndex[t.y], newIndex[t.z]};
}

}  // namespace malus::prep
